// SPDX-License-Identifier: Apache-2.0
#include "ui/film/framesink.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"

#include <QBuffer>
#include <QImage>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char** environ;

namespace ps {
namespace {

constexpr int kJpegQuality = 88;

/// Throws Error when it is too large, or the disk is full.
void writePicture(const std::vector<uint8_t>& pixels, int width, int height, const std::string& path,
                  const char* format) {
  const QImage image(pixels.data(), width, height, 4 * width, QImage::Format_RGBA8888);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!image.convertToFormat(QImage::Format_RGB888).save(&buffer, format, format[0] == 'J' ? kJpegQuality : -1))
    throw Error(path + ": the picture could not be made; choose a smaller size");
  writeFileAtomically(path, {bytes.constData(), static_cast<size_t>(bytes.size())});
}

class PngFolder final : public FrameSink {
 public:
  PngFolder(const std::string& folder, int width, int height) : m_folder(folder), m_width(width), m_height(height) {
    makeFolder(folder);
  }
  void add(const std::vector<uint8_t>& pixels, long frame) override {
    char name[40];
    std::snprintf(name, sizeof name, "frame-%06ld.png", frame);
    const std::string path = (std::filesystem::path(m_folder) / name).string();
    writePicture(pixels, m_width, m_height, path, "PNG");
  }
  void finish() override {}

 private:
  std::string m_folder;
  int m_width, m_height;
};

class OnePicture final : public FrameSink {
 public:
  OnePicture(const std::string& path, int width, int height) : m_path(path), m_width(width), m_height(height) {}
  void add(const std::vector<uint8_t>& pixels, long) override { m_pixels = pixels; }
  void finish() override {
    const bool png = std::filesystem::path(m_path).extension() == ".png";
    if (!m_pixels.empty()) writePicture(m_pixels, m_width, m_height, m_path, png ? "PNG" : "JPEG");
  }

 private:
  std::string m_path;
  int m_width, m_height;
  std::vector<uint8_t> m_pixels;
};

/// Raw frames through a socket to ffmpeg: to write to one that has ended is an error there, and no signal. The film
/// takes its name when it is whole.
class Film final : public FrameSink {
 public:
  Film(const std::string& path, int width, int height, double framesPerSecond)
      : m_path(path), m_words(std::tmpfile(), std::fclose) {
    if (width % 2 || height % 2) throw InputError("--size: a film needs an even width and height");
    if (!m_words) throw Error(std::string("no file for what ffmpeg says: ") + std::strerror(errno));
    makePart();
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.6g", framesPerSecond);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    const std::string file = m_part.starts_with("-") ? "./" + m_part : m_part;
    start({"ffmpeg",   "-y",      "-nostdin",  "-loglevel",  "error", "-f",  "rawvideo", "-pix_fmt",
           "rgba",     "-s",      size,        "-r",         rate,    "-i",  "pipe:0",   "-an",
           "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",    "mp4", file});
  }
  ~Film() override {
    if (m_socket >= 0) ::close(m_socket);
    if (m_process > 0) {
      ::kill(m_process, SIGKILL);  // nobody wants what it would still write
      ::waitpid(m_process, nullptr, 0);
    }
    if (!m_part.empty()) ::unlink(m_part.c_str());
  }
  void add(const std::vector<uint8_t>& pixels, long) override {
    const uint8_t* data = pixels.data();
    for (size_t left = pixels.size(); left > 0;) {
      const ssize_t count = ::send(m_socket, data, left, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        end();  // says why it has ended
        throw Error(m_path + ": ffmpeg ended before the film did");
      }
      data += count;
      left -= static_cast<size_t>(count);
    }
  }
  void finish() override {
    end();
    if (std::rename(m_part.c_str(), m_target.c_str()) != 0)
      throw Error(m_path + ": not saved: " + std::strerror(errno) + "; save elsewhere");
    m_part.clear();
  }

 private:
  /// Waits for ffmpeg. Throws Error where it failed.
  void end() {
    ::close(std::exchange(m_socket, -1));
    int status = 0;
    while (::waitpid(m_process, &status, 0) < 0 && errno == EINTR) {
    }
    m_process = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error(m_path + ": ffmpeg made no film" + lastWords());
  }
  void makePart() {
    requireWritable(m_path);
    m_target = std::filesystem::weakly_canonical(m_path).string();  // behind links
    m_part = m_target + ".part-XXXXXX";
    const int fd = ::mkostemp(m_part.data(), O_CLOEXEC);
    if (fd < 0) throw Error(m_path + ": not saved: " + std::strerror(errno) + "; save elsewhere");
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(fd, 0666 & ~mask);
    ::close(fd);
  }
  /// ": " and the last line of what ffmpeg had to say.
  std::string lastWords() const {
    std::string line, last;
    std::rewind(m_words.get());
    for (int c = std::fgetc(m_words.get()); c != EOF; c = std::fgetc(m_words.get())) {
      if (c != '\n') line += static_cast<char>(c);
      if (c == '\n' && !line.empty()) last = std::exchange(line, {});
    }
    if (!line.empty()) last = line;
    return last.empty() ? "" : ": " + last;
  }
  void start(const std::vector<std::string>& command) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw Error(std::string("no way to ffmpeg: ") + std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ::fileno(m_words.get()), STDERR_FILENO);
    posix_spawnattr_t attributes;  // Ctrl+C is for this program, which then ends the film
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
    arguments.push_back(nullptr);
    const int problem = ::posix_spawnp(&m_process, "ffmpeg", &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    m_socket = ends[1];
    if (problem == 0) return;
    ::close(std::exchange(m_socket, -1));
    ::unlink(m_part.c_str());
    throw Error(m_path + ": films need the program ffmpeg, which " +
                (problem == ENOENT ? "is not installed; install it"
                                   : std::string("does not start: ") + std::strerror(problem)) +
                ", or choose a folder for PNG files");
  }

  std::string m_path, m_target, m_part;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> m_words;
  int m_socket = -1;
  pid_t m_process = -1;
};

}  // namespace

bool isFilm(const std::string& out) { return std::filesystem::path(out).extension() == ".mp4"; }
bool isPicture(const std::string& out) {
  const std::filesystem::path ending = std::filesystem::path(out).extension();
  return ending == ".png" || ending == ".jpg";
}

std::unique_ptr<FrameSink> makeFrameSink(const std::string& out, int width, int height, double framesPerSecond) {
  if (isFilm(out)) return std::make_unique<Film>(out, width, height, framesPerSecond);
  if (isPicture(out)) return std::make_unique<OnePicture>(out, width, height);
  return std::make_unique<PngFolder>(out, width, height);
}

}  // namespace ps
