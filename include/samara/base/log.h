#ifndef samara_base_log_h
#define samara_base_log_h

#include <iostream>
#include <string>

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
      if (!quiet)
        *out << text << std::endl;
    }

    /** Something is doubtful but does not stop the computation. */
    void
    warning(const std::string &where, const std::string &text)
    {
      ++warnings;
      *out << (where.empty() ? "" : where + ": ") << "warning: " << text << std::endl;
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
  };
} // namespace samara

#endif
