// Readers of files with tables of airfoils.

#include <samara/aero/airfoil_table.h>
#include <samara/base/number_in_file.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** The lines of a file, and complaints that say where in it. */
    struct Lines
    {
      std::string              name;
      std::vector<std::string> lines;
      unsigned int             next = 0; ///< the line that is read next

      Lines(const std::string &text, const std::string &name)
        : name(name)
      {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
          {
            if (!line.empty() && line.back() == '\r')
              line.pop_back();
            lines.push_back(line);
          }
      }

      /** About the line that was read last. */
      [[noreturn]] void
      complain(const std::string &problem, const unsigned int back = 0) const
      {
        throw std::invalid_argument(name + ":" + std::to_string(std::max(1u, next - back)) + ": " + problem);
      }

      const std::string &
      read()
      {
        if (next == lines.size())
          complain("the file ends here, and more is expected");
        return lines[next++];
      }

      double
      number(const std::string &text) const
      {
        // Fortran writes 1.2D-3, too
        std::string plain = trim(text);
        for (char &c : plain)
          if (c == 'D' || c == 'd')
            c = 'e';
        double value = 0;
        if (const std::string fault = fault_of_number(plain, value); !fault.empty())
          complain("<" + trim(text) + "> " + fault);
        return value;
      }
    };



    /** What is read of a table before it is checked: angles [deg]. */
    struct RawTable
    {
      std::string               coefficient;
      std::vector<double>       machs, angles;
      std::vector<unsigned int> lines;  ///< of the angles, in the file
      std::vector<double>       values; ///< row by row
    };



    void
    check_increase(const std::vector<double> &numbers, const std::string &what, const std::string &place)
    {
      for (unsigned int i = 1; i < numbers.size(); ++i)
        if (!(numbers[i] > numbers[i - 1]))
          throw std::invalid_argument(place + what + " must increase, and " + number_to_text(numbers[i]) + " follows " +
                                      number_to_text(numbers[i - 1]));
    }



    AirfoilTable
    finished(RawTable raw, const std::string &name, const Beyond beyond)
    {
      const std::string of = " of the table of the " + raw.coefficient;
      check_increase(raw.machs, "the Mach numbers" + of, name + ": ");
      if (raw.machs.front() < 0)
        throw std::invalid_argument(name + ": a Mach number" + of + " is negative");
      for (unsigned int i = 0; i < raw.angles.size(); ++i)
        {
          const std::string place = name + ":" + std::to_string(raw.lines[i]) + ": ";
          if (i > 0)
            check_increase({raw.angles[i - 1], raw.angles[i]}, "the angles" + of, place);
          if (std::abs(raw.angles[i]) > 180 + 1e-9)
            throw std::invalid_argument(place + "the angle " + number_to_text(raw.angles[i]) + of +
                                        " is beyond 180 degrees");
        }
      const unsigned int n_machs = raw.machs.size();
      const double       first = raw.angles.front(), last = raw.angles.back();
      const bool         reaches = first < -180 + 1e-6 && last > 180 - 1e-6;
      if (!reaches && beyond == Beyond::refuse)
        throw std::invalid_argument(name + ": the angles" + of + " reach from " + number_to_text(first) + " to " +
                                    number_to_text(last) +
                                    " degrees, not from -180 to 180; <Beyond = constant> lets the coefficients stay "
                                    "constant beyond");
      // the flow from behind is the same at -180 and 180
      const auto row = [&](const unsigned int i) {
        return std::vector<double>(raw.values.begin() + i * n_machs, raw.values.begin() + (i + 1) * n_machs);
      };
      if (first > -180 + 1e-6)
        {
          const auto copy = row(0);
          raw.angles.insert(raw.angles.begin(), -180);
          raw.values.insert(raw.values.begin(), copy.begin(), copy.end());
        }
      if (last < 180 - 1e-6)
        {
          const auto copy = row(raw.angles.size() - 1);
          raw.angles.push_back(180);
          raw.values.insert(raw.values.end(), copy.begin(), copy.end());
        }
      std::vector<double> angles;
      for (const double angle : raw.angles)
        angles.push_back(angle * M_PI / 180);
      angles.front() = -M_PI;
      angles.back()  = M_PI;
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      return AirfoilTable(angles, raw.machs, Eigen::Map<const RowMajor>(raw.values.data(), angles.size(), n_machs));
    }



    const std::string coefficients[] = {"lift", "drag", "moment"};

    /** How many Mach numbers and angles each of the tables has. */
    std::vector<unsigned int>
    counts(const std::vector<std::string> &texts, const Lines &file)
    {
      std::vector<unsigned int> result;
      for (const auto &text : texts)
        {
          const double n = file.number(text);
          if (n != std::floor(n) || n < 1 || n > 10000)
            file.complain("<" + trim(text) + "> is no count of Mach numbers or angles");
          result.push_back(n);
        }
      for (unsigned int i = 1; i < 6; i += 2)
        if (result[i] < 2)
          file.complain("a table has at least two angles");
      return result;
    }



    RawTable
    read_fixed_table(Lines &file, const unsigned int n_machs, const unsigned int n_angles)
    {
      RawTable table;
      /** @p n numbers in columns of 7 from column 8, nine a line; the first line's first column into @p angle */
      const auto fields = [&](const unsigned int n, std::vector<double> &to, double *const angle) {
        for (unsigned int i = 0; i < n; ++i)
          {
            if (i % 9 == 0)
              {
                const std::string &line = file.read();
                if (i == 0 && angle != nullptr)
                  *angle = file.number(line.substr(0, 7));
                else if (!trim(line.substr(0, 7)).empty())
                  file.complain("columns 1 to 7 must be empty where Mach numbers or values are continued");
              }
            const std::string &line  = file.lines[file.next - 1];
            const unsigned int start = 7 * (i % 9 + 1);
            if (line.size() <= start)
              file.complain("a value is missing: " + std::to_string(n) + " are expected");
            to.push_back(file.number(line.substr(start, 7)));
          }
      };
      fields(n_machs, table.machs, nullptr);
      for (unsigned int i = 0; i < n_angles; ++i)
        {
          double angle = 0;
          fields(n_machs, table.values, &angle);
          table.angles.push_back(angle);
          table.lines.push_back(file.next - (n_machs - 1) / 9);
        }
      return table;
    }



    /** The numbers of a file with blanks between them. */
    struct Words
    {
      Lines             &file;
      std::istringstream line;

      double
      number()
      {
        std::string word;
        while (!(line >> word))
          line = std::istringstream(file.read());
        return file.number(word);
      }
    };



    RawTable
    read_free_table(Words &words, const unsigned int n_machs, const unsigned int n_angles)
    {
      RawTable table;
      for (unsigned int j = 0; j < n_machs; ++j)
        table.machs.push_back(words.number());
      for (unsigned int i = 0; i < n_angles; ++i)
        {
          table.angles.push_back(words.number());
          table.lines.push_back(words.file.next);
          for (unsigned int j = 0; j < n_machs; ++j)
            table.values.push_back(words.number());
        }
      return table;
    }
  } // namespace



  AirfoilTables
  read_c81(const std::string &text, const std::string &name, const Beyond beyond)
  {
    Lines                    file(text, name);
    std::string              head    = file.read();
    const bool               is_free = trim(head).rfind("# FREE FORMAT", 0) == 0;
    std::vector<std::string> texts;
    if (is_free)
      {
        head             = file.read();
        const auto colon = head.rfind(';');
        if (colon == std::string::npos)
          file.complain("the second line of the free format is <name; six numbers>");
        std::istringstream in(head.substr(colon + 1));
        for (std::string word; in >> word;)
          texts.push_back(word);
      }
    else
      for (unsigned int i = 0; i < 6 && head.size() >= 32 + 2 * i; ++i)
        texts.push_back(head.substr(30 + 2 * i, 2));
    if (texts.size() != 6)
      file.complain(is_free ?
                      "six numbers are expected behind the semicolon: of Mach numbers and angles of three tables" :
                      "columns 31 to 42 must hold six numbers of Mach numbers and angles, two columns each");
    const auto   n     = counts(texts, file);
    Words        words = {file, {}};
    AirfoilTable tables[3];
    for (unsigned int i = 0; i < 3; ++i)
      {
        RawTable raw =
          is_free ? read_free_table(words, n[2 * i], n[2 * i + 1]) : read_fixed_table(file, n[2 * i], n[2 * i + 1]);
        raw.coefficient = coefficients[i];
        tables[i]       = finished(raw, name, beyond);
      }
    std::string rest;
    if (is_free && words.line >> rest)
      file.complain("<" + rest + "> is more than the counts of line 2 announce");
    while (file.next < file.lines.size())
      if (!trim(file.read()).empty())
        file.complain("there are more lines than the counts announce");
    return {tables[0], tables[1], tables[2]};
  }



  namespace
  {
    /** Reads AeroDyn's lines "value keyword", skipping others. */
    double
    value_of(const std::string &keyword, Lines &file)
    {
      while (file.next < file.lines.size())
        {
          std::istringstream words(file.read());
          std::string        value, word;
          if (words >> value >> word && value[0] != '!' && word == keyword)
            return file.number(value);
        }
      file.complain("no line says <" + keyword + ">");
    }



    /** A number of rows or tables. */
    unsigned int
    count_of(const std::string &keyword, const unsigned int least, Lines &file)
    {
      const double n = value_of(keyword, file);
      if (n != std::floor(n) || n < least || n > 100000)
        file.complain("<" + keyword + "> is a count of at least " + std::to_string(least));
      return n;
    }
  } // namespace



  AirfoilTables
  read_aerodyn(const std::string &text, const std::string &name, const Beyond beyond, const unsigned int which)
  {
    Lines              file(text, name);
    const unsigned int n_tables = count_of("NumTabs", 1, file);
    if (which > n_tables)
      throw std::invalid_argument(name + " has no table " + std::to_string(which) + ": it has " +
                                  std::to_string(n_tables));
    RawTable     raw[3];
    unsigned int n_columns = 0;
    for (unsigned int k = 1; k <= which; ++k)
      {
        const unsigned int n_rows = count_of("NumAlf", 2, file);
        for (unsigned int i = 0; i < n_rows;)
          {
            const std::string &line = file.read();
            if (trim(line).empty() || trim(line)[0] == '!')
              continue;
            ++i;
            if (k < which)
              continue;
            std::istringstream  words(line);
            std::vector<double> row;
            for (std::string word; words >> word;)
              row.push_back(file.number(word));
            if (n_columns == 0)
              n_columns = row.size();
            if (row.size() < 3 || row.size() != n_columns)
              file.complain("a row holds angle, c_l, c_d and, in all rows or none, c_m");
            for (unsigned int c = 0; c < 3; ++c)
              {
                raw[c].angles.push_back(row[0]);
                raw[c].lines.push_back(file.next);
                raw[c].values.push_back(c + 1 < row.size() ? row[c + 1] : 0.);
              }
          }
      }
    AirfoilTable tables[3];
    for (unsigned int c = 0; c < 3; ++c)
      {
        raw[c].coefficient = coefficients[c];
        raw[c].machs       = {0.};
        tables[c]          = finished(raw[c], name, beyond);
      }
    return {tables[0], tables[1], tables[2]};
  }
} // namespace samara
