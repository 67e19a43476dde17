// SPDX-License-Identifier: Apache-2.0
// What a plugin says of itself: as JSON, as moc puts it into a library, and as the library that holds it. None of its
// code runs.
#include "core/plugin_host/pluginmetadata.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/fuzz.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

namespace {

void check(const ps::PluginInfo& info) {
  ps::fuzz::require(info.problem.empty() || info.problem.find('\n') == std::string::npos, "a problem is one line");
  if (info.problem.empty())
    ps::fuzz::require(ps::problemOfId(info.id).empty() && !info.version.empty() && !info.licence.empty(),
                      "a plugin that is taken says who it is");
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  if (size > 0 && data[0] == '{') {
    const auto bytes = QByteArray::fromRawData(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    PluginInfo info;
    info.problem = checkMetadata(QJsonDocument::fromJson(bytes).object(), info);
    check(info);
  } else {
    static const fuzz::File library("library.so");
    library.write({reinterpret_cast<const char*>(data), size});
    const PluginInfo info = readLibraryMetadata(library.path());
    fuzz::requireMessage(info.problem.empty() ? library.path() + ":" : info.problem, library.path());
    check(info);
  }
  return 0;
}
