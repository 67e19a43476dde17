// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/repositoryrules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <regex>

namespace ps::rules {
namespace {

using View = std::string_view;

// Each may include itself and what stands before it. A new room is entered here, where its arrows allow.
constexpr std::array<View, 14> kCoreRooms = {"base",       "math",  "parameters", "particles",   "matter",
                                             "solver",     "scene", "sketch",     "plugin_host", "geometry",
                                             "simulation", "io",    "export",     "experiments"};
constexpr std::array<View, 18> kUiRooms = {"theme",    "render", "film",   "document", "session", "tools",
                                           "rows",     "panels", "graphs", "fitting",  "curves",  "timeline",
                                           "viewport", "vr",     "help",   "library",  "welcome", "window"};
// Behind the face of the solver: private headers, likewise in order.
constexpr std::array<View, 6> kSolverRooms = {"structure", "contact", "fluid", "heat", "frame", "gpu"};

struct Room {
  View house, name;  // "core", "solver"; plugins and tests have no rooms
};

Room roomOf(View path) {
  const size_t first = path.find('/');
  if (first == View::npos) return {};
  const View house = path.substr(0, first);
  if (house != "core" && house != "ui" && house != "app") return {house, {}};
  const View rest = path.substr(first + 1);
  return {house, rest.substr(0, rest.find('/'))};
}

template <size_t N>
ptrdiff_t rank(const std::array<View, N>& rooms, View name) {
  const auto it = std::find(rooms.begin(), rooms.end(), name);
  return it == rooms.end() ? -1 : it - rooms.begin();
}

/// "heat" of core/solver/heat/radiation.h; "" for the solver's face and for everything else.
View solverRoomOf(View path) {
  constexpr View kSolver = "core/solver/";
  if (!path.starts_with(kSolver)) return {};
  const View rest = path.substr(kSolver.size());
  const size_t slash = rest.find('/');
  return slash == View::npos ? View{} : rest.substr(0, slash);
}

struct Include {
  View target;
  bool quoted;
};

bool startsWithAny(View text, std::initializer_list<View> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](View prefix) { return text.starts_with(prefix); });
}
bool isQt(View target) {
  return target.size() > 1 && target[0] == 'Q' && (std::isupper(target[1]) || target[1] == 't');
}
bool isWidgets(View target) {
  if (startsWithAny(target, {"QtWidgets", "QtOpenGLWidgets", "QOpenGLWidget", "QApplication", "QMainWindow", "QDialog",
                             "QDockWidget", "QMenu", "QAction"}))
    return true;
  return isQt(target) && target.ends_with("Widget");
}
bool isOpenGl(View target) { return startsWithAny(target, {"epoxy/", "GL/", "GLES", "EGL/", "QOpenGL", "QtOpenGL"}); }

std::string coreProblem(View room, const Include& include) {
  if (isOpenGl(include.target)) return "core has no OpenGL";
  if (isQt(include.target)) {
    if (room == "plugin_api") return {};  // only qtentry.h; see sdkProblem
    if (room != "plugin_host") return "only core/plugin_host may use Qt";
    if (isWidgets(include.target) || startsWithAny(include.target, {"QtGui", "QtWidgets"}))
      return "core/plugin_host may use QtCore only";
  }
  return {};
}

std::string sdkProblem(View path, const Include& include) {
  if (include.quoted) return "the SDK includes itself as <phasesketch/...>";
  if (include.target.starts_with("phasesketch/") || include.target == "cstddef" || include.target == "cstdint" ||
      include.target == "cstring")
    return {};
  if (path.ends_with("/qtentry.h") && (include.target == "QObject" || include.target == "QtPlugin")) return {};
  return "the SDK needs nothing but <cstddef>, <cstdint> and <cstring> (qtentry.h: <QObject> and <QtPlugin>)";
}

std::string orderProblem(const Room& from, const Room& to) {
  if (from.name == to.name) return {};
  const bool core = from.house == "core";
  const ptrdiff_t own = core ? rank(kCoreRooms, from.name) : rank(kUiRooms, from.name);
  const ptrdiff_t other = core ? rank(kCoreRooms, to.name) : rank(kUiRooms, to.name);
  const std::string list = std::string(" (order of rooms: tests/unit/repositoryrules.cpp)");
  if (own < 0) return std::string(from.house) + "/" + std::string(from.name) + " is not a known room" + list;
  if (other < 0) return std::string(to.house) + "/" + std::string(to.name) + " is not a known room" + list;
  return other < own ? std::string() : "goes from an earlier room to a later one" + list;
}

// Stages are the solver's own affair; a test of one names its room in CMake.
std::string solverProblem(View path, View target) {
  const View from = solverRoomOf(path), to = solverRoomOf(target);
  const Room house = roomOf(path);
  if (house.house == "tests") return {};
  if (!to.empty() && rank(kSolverRooms, to) < 0) return "is not a known room of the solver";
  const bool inside = house.house == "core" && house.name == "solver";
  if (!to.empty() && !inside) return "is private to core/solver";
  if (from.empty() || from == to) return {};
  if (to.empty())
    return target == "core/solver/solver.h" && from != "frame" ? "stages do not know the solver" : std::string();
  return rank(kSolverRooms, to) < rank(kSolverRooms, from) ? std::string()
                                                           : "goes from an earlier room of the solver to a later one";
}

std::string arrowProblem(const Room& from, const Room& to) {
  if (from.house == "tests") return {};
  if (to.house == "tests") return "the program must not include tests";
  if (from.house == "plugins") return "plugins include <phasesketch/...> only";
  if (to.house == "plugins") return "nothing names a plugin";
  if (to.name == "plugin_api") return "write <phasesketch/...>";
  if (from.house == "core" && to.house != "core") return "core includes core only";
  if (from.house == "ui" && to.house == "app") return "ui must not include app";
  if (from.house == to.house && from.house != "app") return orderProblem(from, to);
  if (from.house == "app" && to.house == "app" && from.name != to.name) return "the programs stand side by side";
  return {};
}

std::string includeProblem(View path, const Include& include) {
  const Room from = roomOf(path);
  if (from.house == "core" && from.name == "plugin_api") return sdkProblem(path, include);
  if (include.target == "Eigen/Core" && path != "core/math/vector.h" && from.house != "plugins")
    return "vectors come through core/math/vector.h";
  std::string problem;
  if (from.house == "core") problem = coreProblem(from.name, include);
  if (from.house == "ui" && from.name == "render" && isQt(include.target)) problem = "ui/render draws without Qt";
  if (from.house == "app" && from.name == "cli" && isWidgets(include.target)) problem = "app/cli has no widgets";
  if (!problem.empty() || !include.quoted) return problem;
  if (include.target.ends_with(".moc")) return {};
  const Room to = roomOf(include.target);
  constexpr std::array<View, 5> kHouses = {"core", "ui", "app", "plugins", "tests"};
  if (rank(kHouses, to.house) >= 0) {
    problem = arrowProblem(from, to);
    return problem.empty() ? solverProblem(path, include.target) : problem;
  }
  if (include.target.find("..") != View::npos) return "climbs out of its folder";
  if (!to.house.empty()) return {};                                 // a library that wants quotes, as Highway does
  if (from.house == "plugins" || from.house == "tests") return {};  // a file beside it
  return "write the path from the project's root";
}

// Calls use(line number from 1, line) for every line.
template <class Use>
void eachLine(View text, Use use) {
  for (size_t begin = 0, number = 1; begin < text.size(); ++number) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    use(number, text.substr(begin, end - begin));
    begin = end + 1;
  }
}

std::string at(View path, size_t line, View what) {
  return std::string(path) + ":" + std::to_string(line) + ": " + std::string(what);
}

/// Calls use(place, match) for all that begins with one of some words, which are found sooner than by an expression.
template <class Use>
void eachMatch(const std::string& text, std::initializer_list<View> beginnings, const std::regex& wanted, Use use) {
  for (const View beginning : beginnings) {
    for (size_t p = text.find(beginning); p != View::npos; p = text.find(beginning, p)) {
      std::smatch match;
      const auto from = text.begin() + static_cast<ptrdiff_t>(p);
      const bool found = std::regex_search(from, text.end(), match, wanted, std::regex_constants::match_continuous);
      if (found) use(p, match);
      p += found ? static_cast<size_t>(match.length()) : beginning.size();
    }
  }
}

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool hasWord(View line, View word) {
  for (size_t p = line.find(word); p != View::npos; p = line.find(word, p + 1)) {
    const size_t end = p + word.size();
    const bool before = p > 0 && isWordCharacter(line[p - 1]) && isWordCharacter(word.front());
    const bool after = end < line.size() && isWordCharacter(line[end]) && isWordCharacter(word.back());
    if (!before && !after) return true;
  }
  return false;
}

}  // namespace

Problems includes(View path, View text) {
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    size_t p = line.find_first_not_of(" \t");
    if (p == View::npos || line[p] != '#') return;
    p = line.find_first_not_of(" \t", p + 1);
    if (p == View::npos || !line.substr(p).starts_with("include")) return;
    p = line.find_first_of("\"<", p);
    if (p == View::npos) return;  // #include MACRO
    const size_t end = line.find(line[p] == '<' ? '>' : '"', p + 1);
    if (end == View::npos) return;
    const Include include{line.substr(p + 1, end - p - 1), line[p] == '"'};
    const std::string problem = includeProblem(path, include);
    if (!problem.empty()) problems.push_back(at(path, number, std::string(include.target) + ": " + problem));
  });
  return problems;
}

Problems licence(View path, View text) {
  const bool mit = startsWithAny(path, {"core/plugin_api/", "plugins/examples/"});
  const std::string wanted = std::string("SPDX-License-") + "Identifier: " + (mit ? "MIT" : "Apache-2.0");
  bool found = false;
  eachLine(text, [&](size_t number, View line) { found = found || (number <= 2 && line.ends_with(wanted)); });
  return found ? Problems{} : Problems{at(path, 1, "must begin with " + wanted)};
}

Problems words(View path, View text) {
  // Put together from halves, so that this file obeys its own rule.
  static const std::array<std::string, 8> kForbidden = {
      std::string("TO") + "DO",   std::string("FIX") + "ME",  std::string("XX") + "X",    std::string("HA") + "CK",
      std::string("/ho") + "me/", std::string("/wo") + "rk/", std::string("/ro") + "ot/", std::string("/Us") + "ers/"};
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    for (const std::string& word : kForbidden)
      if (hasWord(line, word)) problems.push_back(at(path, number, "must not say \"" + word + "\""));
  });
  return problems;
}

Problems colours(View path, View text) {
  if (!startsWithAny(path, {"ui/", "app/editor/", "resources/"})) return {};
  // The two files of colours, and the icon that the desktop shows.
  if (startsWithAny(path, {"resources/theme/tokens.json", "resources/theme/maps.json", "resources/package/"}))
    return {};
  static const std::regex numbers(
      R"((Color|qRgba?|fromRgba?)\((\s*(0x)?[0-9a-fA-F]+\s*,){2,3}\s*(0x)?[0-9a-fA-F]+\s*\))");
  static const std::regex named(R"(Qt::(dark|light)?(white|black|red|green|blue|cyan|magenta|yellow|gr[ae]y)\b)",
                                std::regex::icase);
  const bool picks = path == "ui/rows/colourpicker.cpp";  // paints all colours
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    const bool mayBe = line.find("Color(") != View::npos || line.find("Rgb") != View::npos;  // expressions are slow
    const std::string whole(line);
    if ((mayBe && std::regex_search(whole, numbers)) ||
        (!picks && line.find("Qt::") != View::npos && std::regex_search(whole, named)))
      problems.push_back(at(path, number, "colours are written in resources/theme/tokens.json"));
    for (size_t p = line.find('#'); p != View::npos; p = line.find('#', p + 1)) {
      if (p > 0 && line[p - 1] == '&') continue;          // an HTML entity
      if (line.substr(0, p).ends_with("\\\"")) continue;  // quoted in a message
      const size_t end = std::min(line.find_first_not_of("0123456789abcdefABCDEF", p + 1), line.size());
      const size_t digits = end - p - 1;
      if ((digits == 3 || digits == 4 || digits == 6 || digits == 8) &&
          (end == line.size() || !isWordCharacter(line[end])))
        problems.push_back(at(path, number, "colours are written in resources/theme/tokens.json"));
    }
  });
  return problems;
}

Problems tips(View path, View text) {
  if (!path.starts_with("ui/") && !path.starts_with("app/")) return {};
  if (path == "ui/theme/plaintext.cpp") return {};
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    if (line.find("QToolTip::showText") != View::npos)
      problems.push_back(at(path, number, "tooltips are shown by showTip() of ui/theme/plaintext.h"));
  });
  return problems;
}

Problems boxes(View path, View text) {
  if (!path.starts_with("ui/") && !path.starts_with("app/")) return {};
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    for (const View box : {"QMessageBox", "QInputDialog", "QProgressDialog", "QErrorMessage"})
      if (hasWord(line, box)) problems.push_back(at(path, number, "no " + std::string(box) + ": see NoticeBar"));
    // A dialog that is opened or executed holds the window; menus, which are given a place, do not.
    const bool asksForFiles = path == "ui/window/filenames.cpp";
    for (const View modal : {"setModal", "setWindowModality", "ApplicationModal", "WindowModal"})
      if (hasWord(line, modal)) problems.push_back(at(path, number, std::string(modal) + " holds the window"));
    for (const View call : {"->open()", ".open()", "->exec()", ".exec()"})
      if (line.find(call) != View::npos && !asksForFiles)
        problems.push_back(at(path, number, std::string(call) + " holds the window: see bringUp()"));
  });
  return problems;
}

Problems messages(View path, View text) {
  if (!path.starts_with("ui/") && !path.starts_with("app/")) return {};
  // What is said first: of a refusal its first words, of a notice those behind its level.
  static const std::regex kShout("\"[^\"]*[A-Za-z]!( [^\"]*)?\""),
      kTitle(
          "(?:refuse|refuseUntilEdited)\\(\\s*QStringLiteral\\(\"([^\"]+)\"\\)|"
          "show\\([^,;]+,\\s*MessageLevel::(?:Warning|Error),\\s*QStringLiteral\\(\"([^\"]+)\"\\)"),
      kBare("MessageLevel::Error, [^;]*, (?:sentence\\()?problem\\)+;"),
      kAlone("show\\([^,;]+,\\s*MessageLevel::(?:Warning|Error),\\s*[^,;]+\\);");
  Problems problems;
  const std::string all(text);
  const auto lineOf = [&](size_t place) {
    return static_cast<size_t>(std::count(all.begin(), all.begin() + static_cast<ptrdiff_t>(place), '\n')) + 1;
  };
  eachMatch(all, {"refuse(", "refuseUntilEdited(", "show("}, kTitle, [&](size_t place, const std::smatch& match) {
    const std::string title = match[1].matched ? match[1].str() : match[2].str();
    if (!title.ends_with('.') && !title.ends_with('?'))
      problems.push_back(at(path, lineOf(place), "\"" + title + "\" is no sentence"));
  });
  const auto lacks = [&](size_t place, const std::smatch&) {
    problems.push_back(at(path, lineOf(place), "says what is wrong, and not what follows or what to do"));
  };
  eachMatch(all, {"MessageLevel::Error, "}, kBare, lacks);
  eachMatch(all, {"show("}, kAlone, lacks);
  eachLine(text, [&](size_t number, View line) {
    if (line.find('!') != View::npos && std::regex_search(line.begin(), line.end(), kShout))
      problems.push_back(at(path, number, "messages have no exclamation marks"));
  });
  return problems;
}

Problems documents(View path, View text, const std::vector<std::string>& known) {
  Problems problems;
  eachLine(text, [&](size_t number, View line) {
    for (size_t p = line.find(".md"); p != View::npos; p = line.find(".md", p + 1)) {
      if (p + 3 < line.size() && isWordCharacter(line[p + 3])) continue;
      size_t begin = p;
      while (begin > 0 && (isWordCharacter(line[begin - 1]) || line[begin - 1] == '-')) --begin;
      const std::string name(line.substr(begin, p + 3 - begin));
      if (begin < p && std::find(known.begin(), known.end(), name) == known.end())
        problems.push_back(at(path, number, "there is no " + name));
    }
  });
  return problems;
}

std::vector<std::string> defined(View text) {
  static const std::regex kNamespace("namespace ?([A-Za-z_:]*) ?\\{"), kEnd("\\}  // namespace.*"),
      kDefined(
          "(?:template <.*> )?(?:class|struct|enum class|enum) (?:alignas\\(.*\\) )?([A-Z][A-Za-z0-9]*)(?: final)?"
          "(?: : .*)?(?: ?\\{.*)");
  std::vector<std::string> found, spaces;
  eachLine(text, [&](size_t, View line) {
    if (!startsWithAny(line, {"namespace", "}  // namespace", "template <", "class ", "struct ", "enum "})) return;
    std::cmatch match;
    if (std::regex_match(line.data(), line.data() + line.size(), match, kNamespace)) {
      spaces.push_back(match[1]);
    } else if (std::regex_match(line.data(), line.data() + line.size(), kEnd) && !spaces.empty()) {
      spaces.pop_back();
    } else if (std::regex_match(line.data(), line.data() + line.size(), match, kDefined)) {
      std::string name;
      bool shared = true;
      for (const std::string& space : spaces) {
        shared = shared && !space.empty() && space != "HWY_NAMESPACE";
        name += space + "::";
      }
      if (shared) found.push_back(name + match[1].str());
    }
  });
  return found;
}

Problems names(View path, View text, std::map<std::string, std::string>& before) {
  Problems problems;
  for (const std::string& name : defined(text)) {
    const auto [known, isNew] = before.emplace(name, path);
    if (!isNew && known->second != path)
      problems.push_back(std::string(path) + ": " + name + " is defined in " + known->second + " as well");
  }
  return problems;
}

}  // namespace ps::rules
