#pragma once

namespace stride {

/// The reward for shaping (the paper's Sec. "Reward shaping"),
///
///     F(s, s′) = γ Φ(s′) − Φ(s)        (Ng, Harada and Russell 1999)
///
/// with Φ(s′) = 0 where the episode truly ended (Grześ 2017); a time limit is not an end. γ is the
/// agent's own, per decision. The rewards of n decisions telescope: Σ γⁱ Fᵢ = γⁿ Φ(sₙ) − Φ(s₀),
/// which is this function with γⁿ.
double shaping_reward(double phi, double phi_next, double gamma, bool terminated);

}  // namespace stride
