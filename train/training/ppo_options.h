#pragma once

#include <string>
#include <vector>

namespace stride::training {

/// Proximal policy optimisation (Schulman et al. 2017) with generalised advantage estimation
/// (Schulman et al. 2016).
struct PpoOptions {
  std::vector<int> actor_hidden = {128, 128}, critic_hidden = {128, 128};
  std::string activation = "tanh";
  double gamma = 0.99, lambda = 0.95;  // discount, and decay of the advantage's horizon, a decision
  int horizon = 64;                    // decisions of each environment between two updates
  int epochs = 6;                      // passes over them
  int minibatch = 512;                 // decisions in a step of Adam
  double clip = 0.2;                   // of the ratio of probabilities
  double rate = 3e-4;                  // Adam's step size at first; then kl steers the actor's
  double kl = 0.03, final_kl = 0.01;   // wanted mean divergence from the policy of the batch
  double entropy = 0.003, final_entropy = 0.003;  // weight of the entropy
  double decay_decisions = 4e6;  // over which kl, entropy and the critic's rate anneal
  double final_rate = 0.2;       // share of the critic's rate that is left then
  double gradient_norm_limit = 0.5;
  double alive_per_s = 2, final_alive_per_s = 0.3;  // reward of not having fallen
  double alive_decisions = 600'000;                 // over which it falls
  bool mirror = true;  // each pass sees each decision or its mirror image
};

}  // namespace stride::training
