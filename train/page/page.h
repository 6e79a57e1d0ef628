#pragma once

#include <filesystem>
#include <string>

namespace stride::page {

/// A page about a clip: verdict, the fit's figures and picture, the film with the fitted legs, the
/// frames behind period and speed, and the outliers among the marks. `trajectory` is
/// NAME.trajectory.csv; `video` (or empty: beside it) must be the one that was tracked. Throws
/// Error where it is not there.
std::string clip_page(const std::filesystem::path& trajectory, const std::filesystem::path& video);

/// A page about a run folder: what the agent does, its film, its gait against the human band, its
/// curve (with that of the other seeds, where the folder is one of several named by numbers), and
/// its configuration. Throws Error where the run has not been evaluated.
std::string run_page(const std::filesystem::path& run);

/// A page about an experiment's report folder (results.md and figures), or a folder that holds
/// report/results.md.
std::string experiment_page(const std::filesystem::path& folder);

/// The page that suits what `subject` is.
std::string page_of(const std::filesystem::path& subject, const std::filesystem::path& video);

}  // namespace stride::page
