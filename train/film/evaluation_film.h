#pragma once

#include <filesystem>
#include <optional>

#include "train/film/film_source.h"
#include "train/rollout/rollout.h"

namespace stride::film {

/// The stride of the video that the potential was made of, found beside `near` or among the
/// project's videos; nothing where it, or its calibrated trajectory, is not to be found.
std::optional<SourceStride> find_source(const Potential& potential,
                                        const std::filesystem::path& near);

/// Films the rollout at 50 frames a second beside the source video in phase, and writes the middle
/// frame as `file` with the extension .jpg.
void write_film(const rollout::Rollout& rollout, const osim::Model& model, const std::string& title,
                const std::optional<SourceStride>& source, const std::filesystem::path& file);

}  // namespace stride::film
