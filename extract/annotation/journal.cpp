#include "extract/annotation/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "extract/annotation/change_json.h"
#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride::annotation {
namespace fs = std::filesystem;
namespace {

// Lines of a journal: the first names the format and what it continues; then changes in JSON, and
// `folded SHA-256` before the keypoints file was replaced by one of that hash.
constexpr std::string_view kFirstLine = "stride annotation journal 1 after ";
constexpr std::string_view kFolded = "folded ";
// The first line of a history; then changes in JSON, the last is undone first.
constexpr std::string_view kHistory = "stride annotation history 1 of ";
constexpr std::size_t kMostRemembered = 2000;  // changes

std::string hash_of(const fs::path& file) {
  return fs::exists(file) ? sha256_of_file(file) : std::string();
}

Keypoints opened(const fs::path& file, const Keypoints& fresh) {
  if (!fs::exists(file)) return fresh;
  Keypoints keypoints = load_keypoints(file);
  require(fresh.video_sha256.empty() || keypoints.video_sha256 == fresh.video_sha256,
          "{}: was clicked on another video ({}, SHA-256 {:.12}…) than this one ({}, {:.12}…); "
          "move it away to annotate this one",
          file.string(), keypoints.video, keypoints.video_sha256, fresh.video, fresh.video_sha256);
  return keypoints;
}

bool is_in_use(const fs::path& journal_file) {
  const int descriptor = ::open(journal_file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool locked = descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  if (descriptor >= 0) ::close(descriptor);
  return locked;
}

fs::path unused_name_beside(const fs::path& file) {
  fs::path stem = file;
  stem.replace_extension();
  for (int i = 1;; ++i) {
    fs::path candidate = fmt::format("{}.mine{}.json", stem.string(), i);
    if (!fs::exists(candidate)) return candidate;
  }
}

}  // namespace

/// The open journal file. It is locked as long as it is open.
class AnnotationJournal::Log {
 public:
  explicit Log(const fs::path& file) : file_(file.string()) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    require(descriptor_ >= 0,
            "{}: cannot be written ({}); copy the video into a folder of yours, or say --keypoints "
            "FILE",
            file_, std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw Error(
          fmt::format("{}: another window is annotating this video; close it first", file_));
    }
    size_ = ::lseek(descriptor_, 0, SEEK_END);
  }
  ~Log() { ::close(descriptor_); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// Appends a line and flushes it to the disk. A failure leaves no partial line.
  void append(const std::string& text) {
    const std::string line = text + '\n';
    std::size_t written = 0;
    while (written < line.size()) {
      const ssize_t n = ::write(descriptor_, line.data() + written, line.size() - written);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) give_up();
      written += static_cast<std::size_t>(n);
    }
    if (::fdatasync(descriptor_) != 0) give_up();
    size_ += static_cast<off_t>(line.size());
  }

  void clear() {
    require(::ftruncate(descriptor_, 0) == 0, "{}: cannot be emptied ({})", file_,
            std::strerror(errno));
    size_ = 0;
  }

  void remove() { ::unlink(file_.c_str()); }

 private:
  [[noreturn]] void give_up() {
    const int reason = errno;
    if (::ftruncate(descriptor_, size_) != 0) {
      // A partial line at the end is skipped when the journal is read.
    }
    throw Error(fmt::format("{}: not saved ({}); what was saved before is safe", file_,
                            std::strerror(reason)));
  }

  std::string file_;
  int descriptor_ = -1;
  off_t size_ = 0;  // up to here all lines are whole
};

fs::path journal_file_of(const fs::path& keypoints_file) {
  return fs::path(keypoints_file).replace_extension(".journal");
}

fs::path history_file_of(const fs::path& keypoints_file) {
  return fs::path(keypoints_file).replace_extension(".undo");
}

AnnotationJournal::AnnotationJournal(const fs::path& keypoints_file, const Keypoints& fresh)
    : file_(keypoints_file),
      journal_file_(journal_file_of(keypoints_file)),
      document_(opened(keypoints_file, fresh)),
      base_(hash_of(keypoints_file)),
      log_(std::make_unique<Log>(journal_file_)) {
  load_history();
  const std::string left_over = read_file(journal_file_);
  if (left_over.empty()) {
    start_log();
  } else {
    replay(left_over);
  }
}

AnnotationJournal::~AnnotationJournal() {
  try {
    fold();
    save_history();
    log_->remove();
  } catch (const std::exception& error) {
    fmt::print(stderr, "warning: {}\n", error.what());
  }
}

void AnnotationJournal::load_history() {
  const fs::path file = history_file_of(file_);
  if (!fs::is_regular_file(file)) return;
  std::istringstream lines(read_file(file));
  std::string line;
  std::getline(lines, line);
  // A history of other keypoints, or a damaged one, undoes nothing.
  if (base_.empty() || line != fmt::format("{}{}", kHistory, base_)) return;
  std::vector<Change> history;
  try {
    while (std::getline(lines, line)) history.push_back(change_of(line, file.string()));
  } catch (const Error&) {
    return;
  }
  document_.remember(std::move(history));
}

void AnnotationJournal::save_history() const {
  const std::vector<Change>& history = document_.history();
  if (history.empty()) {
    std::error_code none;
    fs::remove(history_file_of(file_), none);
    return;
  }
  std::string text = fmt::format("{}{}\n", kHistory, base_);
  for (std::size_t i = history.size() - std::min(history.size(), kMostRemembered);
       i < history.size(); ++i)
    text += line_of(history[i]) + '\n';
  write_file_atomically(history_file_of(file_), text);
}

void AnnotationJournal::start_log() {
  log_->clear();
  log_->append(fmt::format("{}{}", kFirstLine, base_.empty() ? "nothing" : base_));
}

void AnnotationJournal::replay(const std::string& content) {
  // A line without an end was being written when the program died; its call never returned.
  std::istringstream lines(content.substr(0, content.rfind('\n') + 1));
  std::string line;
  if (!std::getline(lines, line)) return start_log();
  require(line.starts_with(kFirstLine), "{}:1: not an annotation journal of this program: '{}'",
          journal_file_.string(), line);
  std::string continues = line.substr(kFirstLine.size());
  if (continues == "nothing") continues.clear();

  std::vector<std::string> edits;
  while (std::getline(lines, line)) {
    if (!line.starts_with(kFolded)) {
      edits.push_back(line);
    } else if (line.substr(kFolded.size()) == base_) {
      continues = base_;  // the keypoints file holds everything up to here
      edits.clear();
    }
  }
  if (edits.empty()) return start_log();
  require(continues == base_,
          "{}: holds edits made after an older state of {}, which was changed since; to drop those "
          "edits remove the journal, to keep them restore the older file",
          journal_file_.string(), file_.string());
  for (std::size_t i = 0; i < edits.size(); ++i)
    document_.apply(change_of(edits[i], fmt::format("{}: edit {}", journal_file_.string(), i + 1)));
  recovered_ = static_cast<int>(edits.size());
  folded_ = false;
  fold();
}

void AnnotationJournal::record(const Change& change) {
  log_->append(line_of(change));
  folded_ = false;
  if (base_.empty()) fold();  // so that there is a file from the first click
}

void AnnotationJournal::apply(const Change& change) {
  document_.apply(change);
  try {
    record(change);
  } catch (...) {
    document_.undo();
    throw;
  }
}

std::optional<Change> AnnotationJournal::recorded(Step step, Step back) {
  std::optional<Change> change = (document_.*step)();
  try {
    if (change) record(*change);
  } catch (...) {
    (document_.*back)();
    throw;
  }
  return change;
}

std::optional<Change> AnnotationJournal::undo() {
  return recorded(&AnnotationDocument::undo, &AnnotationDocument::redo);
}

std::optional<Change> AnnotationJournal::redo() {
  return recorded(&AnnotationDocument::redo, &AnnotationDocument::undo);
}

void AnnotationJournal::fold() {
  if (folded_) return;
  const std::string content = text_of(document_.keypoints());
  if (hash_of(file_) != base_) {
    const fs::path edited = std::exchange(file_, unused_name_beside(file_));
    write_file_atomically(file_, content);
    base_ = sha256_of(content);
    folded_ = true;
    throw Error(
        fmt::format("{}: was edited by somebody else meanwhile and is left as it is; this "
                    "annotation goes to {} from now on",
                    edited.string(), file_.string()));
  }
  log_->append(fmt::format("{}{}", kFolded, sha256_of(content)));
  write_file_atomically(file_, content);
  base_ = sha256_of(content);
  folded_ = true;
}

void fold_left_over_journal(const fs::path& keypoints_file) {
  const fs::path journal_file = journal_file_of(keypoints_file);
  if (!fs::exists(keypoints_file) || !fs::exists(journal_file) || is_in_use(journal_file)) return;
  const AnnotationJournal journal(keypoints_file, Keypoints());
}

}  // namespace stride::annotation
