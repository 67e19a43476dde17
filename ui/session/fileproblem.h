// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ps {

/// What a reader says of a project's file ("/data/pond.json:/materials/1/properties/density_solid: must be above 0")
/// for people: the thing by its kind and name first, the place in the file after it. "The material “Wood”, Density,
/// solid: must be above 0 (pond.json, line 41: /materials/1/properties/density_solid)".
class FileProblems {
 public:
  /// `text`: the file's, which must outlive it.
  FileProblems(const QString& path, std::string_view text);
  /// What has no such place stays as it is.
  QString said(const std::string& message);

 private:
  QString m_path;
  std::string_view m_text;
  std::optional<nlohmann::json> m_document;  ///< once it was asked for; discarded: no JSON, or too long to look into
};

/// The line, from 1, on which what a JSON pointer (RFC 6901) names begins in a text that is JSON; of what is not there,
/// that of the last part that is.
size_t lineOfPointer(std::string_view text, std::string_view pointer);

}  // namespace ps
