#include "train/task/tasks.h"

namespace stride::task {
namespace {

class Distance final : public Task {
 public:
  void start(const Moment& first) override {
    start_x_m_ = x_m_ = first.state.q[simulation::kPelvisX];
  }

  Outcome step(const Moment& moment) override {
    x_m_ = moment.state.q[simulation::kPelvisX];
    return {moment.competition.sum(),
            competition::has_fallen(moment.state) ? End::fall : End::none};
  }

  double measure_m() const override { return x_m_ - start_x_m_; }

 private:
  double start_x_m_ = 0, x_m_ = 0;
};

}  // namespace

std::unique_ptr<Task> distance(const TaskOptions&, const osim::Model&) {
  return std::make_unique<Distance>();
}

}  // namespace stride::task
