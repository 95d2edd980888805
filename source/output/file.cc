#include <samara/base/errors.h>
#include <samara/output/file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace samara
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &file, const int error)
    {
      const std::string reason = error != 0 ? ": " + std::generic_category().message(error) : "";
      throw CannotWrite("cannot write " + file + reason + ".");
    }



    int
    error_of_waiting(const std::string &file)
    {
      const int handle = ::open(file.c_str(), O_RDONLY);
      if (handle < 0)
        return errno;
      // what cannot be waited for, such as a pipe, says EINVAL
      const int error = ::fsync(handle) != 0 && errno != EINVAL ? errno : 0;
      ::close(handle);
      return error;
    }
  } // namespace



  void
  make_folder(const std::string &folder)
  {
    std::error_code error, ignored;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, ignored))
      fail(folder, error.value());
  }



  namespace
  {
    /** "process 123 since 12:30:01"; what stands in the file of a lock. */
    std::string
    text_of_lock()
    {
      char              host[256] = {}, at[64] = {};
      const std::time_t now = std::time(nullptr);
      std::tm           local;
      if (gethostname(host, sizeof(host) - 1) != 0)
        host[0] = '\0';
      std::strftime(at, sizeof(at), "%Y-%m-%d %H:%M:%S", localtime_r(&now, &local));
      return "process " + std::to_string(getpid()) + (host[0] != '\0' ? std::string(" on ") + host : "") + ", since " +
             at + "\n";
    }



    /** Whether @p handle is that of the file which has this name now: who held it before may have removed it. */
    bool
    is_still(const int handle, const std::string &file)
    {
      struct stat opened, named;
      return ::fstat(handle, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
             opened.st_dev == named.st_dev;
    }
  } // namespace



  FolderLock::FolderLock(const std::string &folder)
    : file(folder + "/.samara_lock")
  {
    take_it();
  }



  FolderLock::FolderLock(FolderLock &&other) noexcept
    : file(std::move(other.file))
    , handle(other.handle)
  {
    other.handle = -1;
  }



  FolderLock::~FolderLock()
  {
    if (handle < 0)
      return;
    ::unlink(file.c_str()); // before it is let go, or it might be that of the next one
    ::close(handle);
  }



  void
  FolderLock::take_it()
  {
    constexpr unsigned int most_attempts = 100; // each means that another process has just ended
    for (unsigned int attempt = 0; attempt < most_attempts; ++attempt)
      {
        handle = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (handle < 0)
          return; // whoever writes files here says what is wrong
        struct flock whole = {};
        whole.l_type       = F_WRLCK;
        whole.l_whence     = SEEK_SET;
        // of the process, not of the open file: children that outlive a killed parent do not hold it
        if (::fcntl(handle, F_SETLK, &whole) != 0)
          {
            const bool    is_taken = errno == EACCES || errno == EAGAIN;
            std::ifstream in(file);
            std::string   whose;
            std::getline(in, whose);
            ::close(handle);
            handle = -1;
            if (!is_taken)
              return; // the file system knows no locks
            throw CannotWrite("another run writes its results into " + file.substr(0, file.rfind('/')) + " (" +
                              (whose.empty() ? "it has begun just now" : whose) +
                              "): rows of both would be mixed. Wait until it has ended, or stop it.");
          }
        if (!is_still(handle, file))
          {
            ::close(handle);
            handle = -1;
            continue;
          }
        const std::string text = text_of_lock();
        if (::ftruncate(handle, 0) != 0 || ::write(handle, text.data(), text.size()) < 0)
          return; // a full disk: the lock holds without the words
        return;
      }
  }



  std::ofstream
  open_file(const std::string &file, const bool append)
  {
    errno = 0;
    std::ofstream stream(file, append ? std::ios::binary | std::ios::app : std::ios::binary);
    if (!stream)
      fail(file, errno);
    return stream;
  }



  void
  flush(std::ofstream &stream, const std::string &file)
  {
    write_now(stream, "", file);
  }



  void
  write_now(std::ofstream &stream, const std::string &content, const std::string &file)
  {
    errno = 0;
    stream << content << std::flush;
    if (!stream)
      fail(file, errno);
  }



  void
  wait_for_disk(const std::string &file)
  {
    if (const int error = error_of_waiting(file))
      fail(file, error);
  }



  void
  replace_file(const std::string &file, const std::string &content, const bool wait)
  {
    const std::string part   = part_of(file);
    std::ofstream     stream = open_file(part);

    errno = 0;
    stream << content << std::flush;
    stream.close();
    const bool failed = !stream;
    const int  error  = failed ? errno : wait ? error_of_waiting(part) : 0;
    if (failed || error != 0)
      {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        fail(file, error);
      }
    replace_by_part(file);
  }



  std::string
  part_of(const std::string &file)
  {
    return file + ".part";
  }



  void
  replace_by_part(const std::string &file)
  {
    std::error_code error, ignored;
    std::filesystem::rename(part_of(file), file, error);
    if (!error)
      return;
    std::filesystem::remove(part_of(file), ignored);
    fail(file, error.value());
  }



  void
  cut_file(const std::string &file, const std::uintmax_t size)
  {
    std::error_code error;
    std::filesystem::resize_file(file, size, error);
    if (error)
      fail(file, error.value());
  }



  std::string
  file_name_of(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      result += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
    return result;
  }



  std::string
  FileNames::next(const std::string &text)
  {
    const auto is_new = [&](std::string name) {
      for (char &c : name)
        c = std::tolower(static_cast<unsigned char>(c));
      return taken.insert(name).second;
    };
    const std::string first = file_name_of(text);
    std::string       name  = first;
    for (unsigned int i = 2; !is_new(name); ++i)
      name = first + "_" + std::to_string(i);
    return name;
  }



  std::string
  csv_line(const std::vector<std::string> &fields)
  {
    std::string line;
    for (const std::string &field : fields)
      {
        if (&field != &fields.front())
          line += ',';
        if (field.find_first_of(",\"\n\r") == std::string::npos)
          {
            line += field;
            continue;
          }
        line += '"';
        for (const char c : field)
          line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
      }
    return line + '\n';
  }



  std::string
  number_to_field(const double number, const unsigned int digits)
  {
    std::string text;
    append_number(text, number, digits);
    return text;
  }



  void
  append_number(std::string &line, const double number, const unsigned int digits)
  {
    char       buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), number, std::chars_format::general, digits).ptr;
    line.append(buffer, end);
  }



  bool
  is_up_to(const double recorded, const double limit)
  {
    // at most half a unit of the last digit was lost
    const double lost = 0.5 * std::pow(10., 1. - digits_of_records);
    return recorded <= limit + 2 * lost * std::abs(limit);
  }
} // namespace samara
