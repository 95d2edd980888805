// The shorthand of layups, such as [0/±45/90_2]s.

#include <samara/section/laminate.h>

#include <cstdlib>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Reads one sequence after another from a text; positions in messages count from 1. */
    class LayupReader
    {
    public:
      explicit LayupReader(const std::string &text)
        : text(text)
      {}

      std::vector<double>
      all()
      {
        const std::vector<double> angles = sequence();
        skip_spaces();
        if (at < text.size())
          fail("what follows is not understood");
        if (angles.empty())
          fail("a layup needs an angle");
        return angles;
      }

    private:
      const std::string &text;
      std::size_t        at            = 0;
      bool               has_half_last = false; ///< the last ply of the sequence is the middle of a symmetric one

      static constexpr unsigned int most_repetitions = 1000;

      [[noreturn]] void
      fail(const std::string &why) const
      {
        throw std::invalid_argument("layup <" + text + ">, character " + std::to_string(at + 1) + ": " + why);
      }

      void
      skip_spaces()
      {
        while (at < text.size() && text[at] == ' ')
          ++at;
      }

      bool
      take(const std::string &word)
      {
        skip_spaces();
        if (text.compare(at, word.size(), word) != 0)
          return false;
        at += word.size();
        return true;
      }

      unsigned int
      repetitions()
      {
        if (!take("_"))
          return 1;
        const std::size_t begin = at;
        unsigned int      n     = 0;
        while (at < text.size() && text[at] >= '0' && text[at] <= '9' && n <= most_repetitions)
          n = 10 * n + (text[at++] - '0');
        if (begin == at || n == 0 || n > most_repetitions)
          fail("a number of repetitions from 1 to 1000 is wanted behind _");
        return n;
      }

      double
      number()
      {
        skip_spaces();
        char        *end   = nullptr;
        const double value = std::strtod(text.c_str() + at, &end);
        if (end == text.c_str() + at || !(std::abs(value) <= 360))
          fail("an angle in degrees is wanted here");
        at = end - text.c_str();
        return value;
      }

      /** Plies and groups separated by /. */
      std::vector<double>
      sequence()
      {
        std::vector<double> angles;
        has_half_last = false;
        do
          {
            if (has_half_last)
              fail("a ply with ~ is the last one of a symmetric layup");
            const std::vector<double> next = take("[") ? group() : ply();
            angles.insert(angles.end(), next.begin(), next.end());
          }
        while (take("/"));
        return angles;
      }

      std::vector<double>
      ply()
      {
        const bool          both  = take("±") || take("+-");
        const double        angle = number();
        std::vector<double> one   = both ? std::vector<double>{angle, -angle} : std::vector<double>{angle}, all;
        for (unsigned int i = 0, n = repetitions(); i < n; ++i)
          all.insert(all.end(), one.begin(), one.end());
        has_half_last = take("~");
        return all;
      }

      std::vector<double>
      group()
      {
        const std::vector<double> inside = sequence();
        const bool                half   = has_half_last;
        has_half_last                    = false;
        if (!take("]"))
          fail("] is missing");
        std::vector<double> all;
        for (unsigned int i = 0, n = repetitions(); i < n; ++i)
          all.insert(all.end(), inside.begin(), inside.end());
        if (take("s") || take("S"))
          {
            const std::size_t n = all.size() - (half ? 1 : 0);
            for (std::size_t i = n; i > 0; --i)
              all.push_back(all[i - 1]);
          }
        else if (half)
          fail("a middle ply, with ~, needs a symmetric layup: [...]s");
        return all;
      }
    };
  } // namespace



  std::vector<double>
  layup_angles(const std::string &text)
  {
    return LayupReader(text).all();
  }
} // namespace samara
