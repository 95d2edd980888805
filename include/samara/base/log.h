#ifndef samara_base_log_h
#define samara_base_log_h

#include <iostream>
#include <string>

#include <unistd.h>

namespace samara
{
  /** What the program tells while it runs. An ordinary object, handed to whoever has something to say. */
  class Log
  {
  public:
    /** A quiet log prints warnings only. */
    explicit Log(std::ostream &out = std::cout, const bool quiet = false)
      : out(&out)
      , quiet(quiet)
    {}

    /** One line of progress; seen at once, also through a pipe. */
    void
    line(const std::string &text)
    {
      keep(text);
      if (!quiet)
        *out << text << std::endl;
    }

    /** How far a long computation is; on a terminal each takes the place of the one before. */
    void
    progress(const std::string &text)
    {
      if (quiet)
        return;
      if (out == &std::cout && isatty(STDOUT_FILENO))
        *out << '\r' << text << "\033[K" << std::flush;
      else
        *out << text << std::endl;
    }

    /** Whether progress() can be called often. */
    bool
    is_terminal() const
    {
      return out == &std::cout && isatty(STDOUT_FILENO);
    }

    /** Something is doubtful but does not stop the computation. */
    void
    warning(const std::string &where, const std::string &text)
    {
      ++warnings;
      const std::string all = (where.empty() ? "" : where + ": ") + "warning: " + text;
      keep(all);
      *out << all << std::endl;
    }

    /** All lines and warnings so far, also those that a quiet log did not print; the first megabyte of them. */
    const std::string &
    text() const
    {
      return kept;
    }

    unsigned int
    n_warnings() const
    {
      return warnings;
    }

  private:
    std::ostream *out;
    bool          quiet;
    unsigned int  warnings = 0;
    std::string   kept;

    void
    keep(const std::string &text)
    {
      constexpr std::size_t most = 1000000;
      if (kept.size() < most)
        kept += text + '\n';
    }
  };
} // namespace samara

#endif
