// SPDX-License-Identifier: Apache-2.0
#include "app/cli/framesink.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"

#include <QBuffer>
#include <QImage>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace ps::cli {
namespace {

class PngFolder final : public FrameSink {
 public:
  PngFolder(const std::string& folder, int width, int height) : m_folder(folder), m_width(width), m_height(height) {
    makeFolder(folder);
  }
  void add(const std::vector<uint8_t>& pixels, long frame) override {
    char name[40];
    std::snprintf(name, sizeof name, "frame-%06ld.png", frame);
    const std::string path = (std::filesystem::path(m_folder) / name).string();
    const QImage image(pixels.data(), m_width, m_height, 4 * m_width, QImage::Format_RGBA8888);
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!image.convertToFormat(QImage::Format_RGB888).save(&buffer, "PNG")) {
      throw Error(path + ": the picture could not be made; choose a smaller size");
    }
    writeFileAtomically(path, {bytes.constData(), static_cast<size_t>(bytes.size())});
  }
  void finish() override {}

 private:
  std::string m_folder;
  int m_width, m_height;
};

/// Raw frames through a pipe to ffmpeg.
class Film final : public FrameSink {
 public:
  Film(const std::string& path, int width, int height, double framesPerSecond) : m_path(path) {
    if (width % 2 || height % 2) throw InputError("--size: a film needs an even width and height");
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.6g", framesPerSecond);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    const std::string file = path.starts_with("-") ? "./" + path : path;
    start({"ffmpeg", "-y", "-loglevel", "error", "-f",  "rawvideo", "-pix_fmt", "rgba",      "-s",         size,
           "-r",     rate, "-i",        "-",     "-an", "-pix_fmt", "yuv420p",  "-movflags", "+faststart", file});
  }
  ~Film() override {
    if (m_pipe >= 0) ::close(m_pipe);
    if (m_process > 0) ::waitpid(m_process, nullptr, 0);
  }
  void add(const std::vector<uint8_t>& pixels, long) override {
    const uint8_t* data = pixels.data();
    for (size_t left = pixels.size(); left > 0;) {
      const ssize_t count = ::write(m_pipe, data, left);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw Error(m_path + ": ffmpeg stopped; see its message above");
      data += count;
      left -= static_cast<size_t>(count);
    }
  }
  void finish() override {
    ::close(m_pipe);
    m_pipe = -1;
    int status = 0;
    ::waitpid(m_process, &status, 0);
    m_process = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error(m_path + ": ffmpeg failed; see its message above");
  }

 private:
  void start(const std::vector<std::string>& command) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe to ffmpeg: ") + std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
    arguments.push_back(nullptr);
    const int problem = ::posix_spawnp(&m_process, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    m_pipe = ends[1];
    if (problem == 0) return;
    m_process = -1;
    ::close(m_pipe);
    m_pipe = -1;
    throw Error(m_path + ": films need the program ffmpeg, which " +
                (problem == ENOENT ? "is not installed; install it"
                                   : std::string("does not start: ") + std::strerror(problem)) +
                ", or give --out a folder for PNG files");
  }

  std::string m_path;
  int m_pipe = -1;
  pid_t m_process = -1;
};

}  // namespace

bool isFilm(const std::string& out) { return std::filesystem::path(out).extension() == ".mp4"; }

std::unique_ptr<FrameSink> makeFrameSink(const std::string& out, int width, int height, double framesPerSecond) {
  if (isFilm(out)) return std::make_unique<Film>(out, width, height, framesPerSecond);
  return std::make_unique<PngFolder>(out, width, height);
}

}  // namespace ps::cli
