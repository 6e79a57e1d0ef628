#pragma once

#include <vector>

#include "extract/tracking/gaussian_process/gait_process.h"
#include "extract/tracking/gaussian_process/samples.h"

namespace stride::gaussian_process {

/// Clicks of the pelvis and of joints of both legs that are explained together: a joint is where
/// the pelvis is and its own motion. Only so the noise of the pelvis' clicks is told from its
/// motion: all joints seem to be off with it.
struct JointData {
  GroupData pelvis;             // places about their mean
  std::vector<GroupData> legs;  // places about the mean of the pelvis and their own about it
};

/// −log of the probability of the clicks, without constants; both kernels' noise counts.
double negative_log_likelihood(const GaitPrior& prior, const JointData& data);

/// The prior with the hyperparameters near its own under which the clicks are most likely.
GaitPrior refined_together(const GaitPrior& prior, const JointData& data, int rounds);

}  // namespace stride::gaussian_process
