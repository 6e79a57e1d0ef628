#include "extract/annotation/qt_wheel.h"

#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>
#include <utility>

namespace stride::annotation {
namespace {

class Filter final : public QObject {
 public:
  explicit Filter(std::function<void(int)> turned) : turned_(std::move(turned)) {}

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::Wheel || !watched->isWidgetType()) return false;
    const int turn = static_cast<QWheelEvent*>(event)->angleDelta().y();
    if (turn != 0) turned_(turn > 0 ? 1 : -1);
    return true;
  }

 private:
  std::function<void(int)> turned_;
};

}  // namespace

QtWheel::QtWheel(std::function<void(int)> turned)
    : filter_(std::make_unique<Filter>(std::move(turned))) {
  if (qApp != nullptr) qApp->installEventFilter(filter_.get());
}

QtWheel::~QtWheel() {
  if (qApp != nullptr) qApp->removeEventFilter(filter_.get());
}

}  // namespace stride::annotation
