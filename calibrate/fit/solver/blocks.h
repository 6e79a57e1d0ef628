#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/sized_cost_function.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "calibrate/runner/runner.h"

namespace stride::fit {

/// How many parameters a block of the runner has.
template <auto kBlock>
inline constexpr int kSizeOf =
    std::tuple_size_v<std::remove_cvref_t<decltype(std::declval<Runner>().*kBlock)>>;

/// Sizes of parameter blocks that are not the runner's: the pelvis of a frame, the ground.
template <int... kSizes>
struct Others {};

/// A block of so many parameters, as a residual takes it.
template <typename T, int kSize>
using Block = const T*;

/// What a residual depends on, in the order of its arguments: blocks of the runner, then others.
template <int kResiduals, typename Others, auto... kBlocks>
struct Blocks;

template <int kResiduals, int... kOthers, auto... kBlocks>
struct Blocks<kResiduals, Others<kOthers...>, kBlocks...> {
  using Sized = ceres::SizedCostFunction<kResiduals, kSizeOf<kBlocks>..., kOthers...>;
  template <typename Residual>
  using Automatic =
      ceres::AutoDiffCostFunction<Residual, kResiduals, kSizeOf<kBlocks>..., kOthers...>;

  /// Where they are.
  template <typename... Pointers>
  static std::vector<double*> of(Runner& runner, Pointers... others) {
    static_assert(sizeof...(others) == sizeof...(kOthers));
    return {(runner.*kBlocks).data()..., others...};
  }
};

/// A residual with automatic derivatives.
template <typename Residual>
using AutomaticCost = typename Residual::DependsOn::template Automatic<Residual>;

}  // namespace stride::fit
