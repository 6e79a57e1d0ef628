#include "extract/annotation/qt_events.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>
#include <utility>

namespace stride::annotation {
namespace {

class Filter final : public QObject {
 public:
  Filter(std::function<void(int)> wheel, std::function<void()> tab)
      : wheel_(std::move(wheel)), tab_(std::move(tab)) {}

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (!watched->isWidgetType()) return false;
    if (event->type() == QEvent::Wheel) {
      const int turn = static_cast<QWheelEvent*>(event)->angleDelta().y();
      if (turn != 0) wheel_(turn > 0 ? 1 : -1);
      return true;
    }
    if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Tab) {
      tab_();
      return true;
    }
    return false;
  }

 private:
  std::function<void(int)> wheel_;
  std::function<void()> tab_;
};

}  // namespace

QtEvents::QtEvents(std::function<void(int)> wheel, std::function<void()> tab)
    : filter_(std::make_unique<Filter>(std::move(wheel), std::move(tab))) {
  if (qApp != nullptr) qApp->installEventFilter(filter_.get());
}

QtEvents::~QtEvents() {
  if (qApp != nullptr) qApp->removeEventFilter(filter_.get());
}

}  // namespace stride::annotation
