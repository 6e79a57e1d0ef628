#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "extract/annotation/document.h"

namespace stride::annotation {

/// An annotation that is always on disk. Each edit appends a line to NAME.keypoints.journal and
/// flushes it before the call returns; fold() writes NAME.keypoints.json by an atomic rename. If
/// the program is killed, the next one to open the annotation finds every edit whose call had
/// returned.
///
/// What can be undone is kept beside it as NAME.keypoints.undo for the next window, as long as the
/// keypoints are those that it belongs to.
///
/// NAME.keypoints.json is replaced only if it is unchanged since it was read or written here, so a
/// file that was edited meanwhile or written by a newer version is never lost.
class AnnotationJournal {
 public:
  /// Opens the annotation of a video: its keypoints file, or else `fresh`, and then the edits that
  /// a killed program left in the journal. Throws Error if another window has it open, if the
  /// folder is not writable, if the keypoints belong to another video than `fresh` or to a newer
  /// version, or if they were edited after the journal was left behind.
  AnnotationJournal(const std::filesystem::path& keypoints_file, const Keypoints& fresh);
  ~AnnotationJournal();  // folds; a failure is reported on stderr and the journal kept
  AnnotationJournal(const AnnotationJournal&) = delete;
  AnnotationJournal& operator=(const AnnotationJournal&) = delete;

  const AnnotationDocument& document() const { return document_; }
  const std::filesystem::path& file() const { return file_; }  // where it is folded to
  int recovered() const { return recovered_; }  // edits recovered from a killed program

  /// As AnnotationDocument's, and on disk on return. If the disk fails (full, read only), the edit
  /// is undone and the Error names the file and the reason.
  void apply(const Change& change);
  std::optional<Change> undo();
  std::optional<Change> redo();

  bool is_folded() const { return folded_; }
  /// Throws Error if the file was edited meanwhile, naming the file that is used from now on; or if
  /// it cannot be written, in which case the journal is kept.
  void fold();

 private:
  class Log;
  void start_log();
  void replay(const std::string& content);

  void record(const Change& change);
  using Step = std::optional<Change> (AnnotationDocument::*)();
  /// A step through the document's history; where it cannot be recorded, the step back too.
  std::optional<Change> recorded(Step step, Step back);
  void load_history();
  void save_history() const;

  std::filesystem::path file_, journal_file_;
  AnnotationDocument document_;
  std::string base_;  // SHA-256 of the keypoints file that the journal continues; empty: no file
  std::unique_ptr<Log> log_;
  int recovered_ = 0;
  bool folded_ = true;
};

/// Folds the journal that a killed `stride annotate` left, for programs that only read the
/// keypoints. Does nothing without a journal or while a window has it open.
void fold_left_over_journal(const std::filesystem::path& keypoints_file);

std::filesystem::path history_file_of(const std::filesystem::path& keypoints_file);

std::filesystem::path journal_file_of(const std::filesystem::path& keypoints_file);

}  // namespace stride::annotation
