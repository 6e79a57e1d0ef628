#pragma once

#include <vector>

#include "extract/tracking/gaussian_process/gait_process.h"
#include "extract/tracking/gaussian_process/samples.h"

namespace stride::gaussian_process {

/// Clicks of the pelvis and of the joints of both legs, modelled jointly: the position of a joint
/// is the position of the pelvis plus its own motion. This identifies the noise of the pelvis
/// clicks, which appears in every joint relative to the pelvis.
struct JointData {
  GroupData pelvis;             // positions minus their mean
  std::vector<GroupData> legs;  // positions minus the pelvis' mean and their own mean
};

/// −log likelihood of the clicks without constants, with the noise of both kernels.
double negative_log_likelihood(const GaitPrior& prior, const JointData& data);

/// Maximises the likelihood over the hyperparameters, starting at the prior's own.
GaitPrior refined_together(const GaitPrior& prior, const JointData& data, int rounds);

}  // namespace stride::gaussian_process
