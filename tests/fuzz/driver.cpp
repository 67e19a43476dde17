// SPDX-License-Identifier: Apache-2.0
// What stands in for libFuzzer where the compiler has none: [--seconds S] [--seed N] FILE|FOLDER... runs all these
// inputs, and then for S seconds what a generator makes of them, the same for the same seed. An input that ends the
// program, or takes a minute, is left in the working directory as finding-TARGET.
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
extern "C" void __sanitizer_set_death_callback(void (*callback)());
#endif

namespace {

constexpr unsigned kLongest = 60;  // s for one input
constexpr size_t kMostBytes = size_t{64} << 10;

std::string g_input, g_finding;

/// Calls nothing but what may be called in a signal handler.
void keepInput() {
  const int file = ::open(g_finding.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const bool whole = file >= 0 && ::write(file, g_input.data(), g_input.size()) >= 0;
  const std::string_view words = whole ? "\nthe input that ended it: " : "\nthe input could not be kept: ";
  (void)!::write(STDERR_FILENO, words.data(), words.size());
  (void)!::write(STDERR_FILENO, g_finding.data(), g_finding.size());
  (void)!::write(STDERR_FILENO, "\n", 1);
}

void onSignal(int number) {
  std::signal(number, SIG_DFL);
  keepInput();
  ::raise(number);
}

void run(std::string input) {
  g_input = std::move(input);
  ::alarm(kLongest);
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(g_input.data()), g_input.size());
  ::alarm(0);
}

std::vector<std::string> seedsOf(const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path path : paths) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    ps::fuzz::require(file.is_open(), "an input can be read: " + path.string());
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

/// Makes inputs of seeds: for one start of its numbers the same ones in the same order everywhere.
class Mutator {
 public:
  Mutator(const std::vector<std::string>& seeds, uint64_t start) : m_seeds(seeds), m_random(start) {}

  std::string next() {
    std::string input = seed();
    for (size_t changes = 1 + below(4); changes > 0; --changes) change(input);
    if (input.size() > kMostBytes) input.resize(kMostBytes);
    return input;
  }

 private:
  size_t below(size_t bound) { return m_random() % bound; }
  const std::string& seed() { return m_seeds[below(m_seeds.size())]; }
  size_t placeIn(const std::string& text) { return below(text.size() + 1); }
  std::string pieceOf(const std::string& text, size_t longest) {
    return text.substr(placeIn(text), 1 + below(longest));
  }

  void change(std::string& input) {
    const size_t at = placeIn(input);
    switch (below(6)) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < input.size()) input[at] = static_cast<char>(below(256));
        break;
      case 2:
        input.erase(at, 1 + below(16));
        break;
      case 3:
        input.insert(at, pieceOf(input, 64));
        break;
      case 4:
        input.insert(at, pieceOf(seed(), 64));
        break;
      default:
        otherNumber(input, at);
    }
  }

  /// Puts a number that is at an end of something into the place of one that stands behind `at`.
  void otherNumber(std::string& input, size_t at) {
    static constexpr std::array<const char*, 16> kNumbers{
        "0",    "-0",    "1",     "-1",    "0.5", "1e-9",       "1e-320",     "1e9",
        "1e18", "1e300", "1e400", "-1e18", "255", "2147483648", "4294967295", "18446744073709551615"};
    constexpr const char* kDigits = "0123456789";
    const size_t first = input.find_first_of(kDigits, at);
    if (first == std::string::npos) return;
    const size_t end = std::min(input.find_first_not_of("0123456789.eE+-", first), input.size());
    input.replace(first, end - first, kNumbers[below(kNumbers.size())]);
  }

  const std::vector<std::string>& m_seeds;
  std::mt19937_64 m_random;
};

}  // namespace

int main(int argc, char** argv) {
  double seconds = 0;
  uint64_t start = 20261123;
  std::vector<std::string> paths;
  for (int i = 1; i < argc; ++i) {
    if (argv[i] == std::string("--seconds") && i + 1 < argc)
      seconds = std::strtod(argv[++i], nullptr);
    else if (argv[i] == std::string("--seed") && i + 1 < argc)
      start = std::strtoull(argv[++i], nullptr, 10);
    else
      paths.emplace_back(argv[i]);
  }
  g_finding = std::filesystem::absolute("finding-" + std::filesystem::path(argv[0]).filename().string()).string();
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM}) std::signal(number, onSignal);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(keepInput);
#endif
  const std::vector<std::string> seeds = seedsOf(paths);
  ps::fuzz::require(!seeds.empty(), "there are inputs to run");
  for (const std::string& seed : seeds) run(seed);
  Mutator mutator(seeds, start);
  size_t count = 0;
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < seconds) {
    run(mutator.next());
    ++count;
  }
  std::printf("%zu seeds and %zu inputs made of them\n", seeds.size(), count);
  return 0;
}
