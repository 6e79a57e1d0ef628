#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "extract/annotation/document.h"

namespace stride::annotation {

/// An annotation that is on disk at every moment. Each edit is a line at the end of
/// NAME.keypoints.journal, flushed to the disk before the call returns; fold() puts the whole into
/// NAME.keypoints.json by an atomic rename. Whatever kills the program between two calls, or within
/// one, the next to open the annotation finds every edit that had returned.
///
/// NAME.keypoints.json is replaced only while it still is what was read or written here: of a file
/// that somebody edited meanwhile, or that a newer program wrote, nothing is lost.
class AnnotationJournal {
 public:
  /// Opens the annotation of a video: its keypoints file if there is one, else `fresh`, and then
  /// whatever a killed program left in the journal. Throws Error if another window has it open, if
  /// the folder cannot be written, if the keypoints belong to another video than `fresh` or are of
  /// a newer version, or if they were edited after the journal had been left behind.
  AnnotationJournal(const std::filesystem::path& keypoints_file, const Keypoints& fresh);
  ~AnnotationJournal();  // folds; a failure is reported on stderr and the journal kept
  AnnotationJournal(const AnnotationJournal&) = delete;
  AnnotationJournal& operator=(const AnnotationJournal&) = delete;

  const AnnotationDocument& document() const { return document_; }
  const std::filesystem::path& file() const { return file_; }  // where it is folded to
  int recovered() const { return recovered_; }  // edits that a killed program had left

  /// As of AnnotationDocument, and on disk on return. Where the disk refuses (full, read only), the
  /// edit is taken back and Error names the file and the reason.
  void apply(Change change);
  std::optional<Change> undo();
  std::optional<Change> redo();

  bool is_folded() const { return folded_; }
  /// Throws Error if the file was edited meanwhile, saying beside it where this annotation goes
  /// from now on; or if it cannot be written, and then the journal is kept.
  void fold();

 private:
  class Log;
  void start_log();
  void replay(const std::string& content);

  void record(const Change& change);

  std::filesystem::path file_, journal_file_;
  AnnotationDocument document_;
  std::string base_;  // SHA-256 of the keypoints file that the journal continues; empty: no file
  std::unique_ptr<Log> log_;
  int recovered_ = 0;
  bool folded_ = true;
};

/// Folds what a killed `stride annotate` left beside a keypoints file, for programs that only read
/// it. Nothing happens without a journal or while a window has it open.
void fold_left_over_journal(const std::filesystem::path& keypoints_file);

std::filesystem::path journal_file_of(const std::filesystem::path& keypoints_file);

}  // namespace stride::annotation
