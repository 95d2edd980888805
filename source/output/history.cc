#include <samara/base/errors.h>
#include <samara/base/finite.h>
#include <samara/output/file.h>
#include <samara/output/history.h>
#include <samara/output/number_rows.h>
#include <samara/output/write_hdf5.h>

#include <deal.II/base/exceptions.h>

#include <exception>
#include <filesystem>
#include <iostream>

namespace samara
{
  namespace
  {
    constexpr std::chrono::milliseconds longest_delay(200);
    constexpr std::size_t               longest_lines = 1 << 18; // bytes
    constexpr std::uint64_t             rows_a_block  = 4096;

    std::string
    header_of(const std::vector<std::pair<std::string, std::string>> &columns)
    {
      std::vector<std::string> fields;
      for (const auto &[column, unit] : columns)
        fields.push_back(unit.empty() || unit == "1" ? column : column + " [" + unit + "]");
      return csv_line(fields);
    }



    /** Whether nothing, or only a piece of @p header, was written before the run was killed. */
    bool
    is_stub(const std::string &file, const std::string &header)
    {
      std::ifstream in(file, std::ios::binary);
      const bool    is_open = in.is_open();
      std::string   found(header.size(), '\0');
      in.read(found.data(), found.size());
      found.resize(in.gcount());
      return is_open && found.size() < header.size() && header.compare(0, found.size(), found) == 0;
    }
  } // namespace



  History::History(const std::string                                      &folder,
                   const std::string                                      &name,
                   const std::vector<std::pair<std::string, std::string>> &columns,
                   const std::optional<double>                            &resume_after,
                   const std::optional<std::uint64_t>                     &n_expected)
    : columns(columns)
    , csv_file(folder + "/" + name + ".csv")
    , hdf5_file(folder + "/" + name + ".h5")
    , header(header_of(columns))
    , time_of_writing(std::chrono::steady_clock::now())
  {
    make_folder(folder);
    const bool resumes = resume_after && keep_rows(*resume_after, n_expected);
    csv                = open_file(csv_file, resumes);
    if (!resumes)
      write_now(csv, header, csv_file);

    // that of an earlier run, which does not fit the CSV file any more
    std::error_code ignored;
    if (std::filesystem::is_regular_file(hdf5_file, ignored))
      std::filesystem::remove(hdf5_file, ignored);
  }



  History::~History()
  {
    try
      {
        finish();
      }
    catch (const std::exception &error)
      {
        std::cerr << "Warning: " << error.what() << std::endl;
      }
  }



  bool
  History::keep_rows(const double resume_after, const std::optional<std::uint64_t> &n_expected)
  {
    const auto check = [&]() {
      if (n_expected && n_rows != *n_expected)
        throw InputError(csv_file + " has " + std::to_string(n_rows) +
                         " rows up to where the run shall go on, not the " + std::to_string(*n_expected) +
                         " that it had there. Put the rows back, or start without --restart.");
    };
    if (!std::filesystem::exists(csv_file) || is_stub(csv_file, header))
      {
        check();
        return false;
      }
    std::uintmax_t end = 0;
    try
      {
        NumberRows          rows(csv_file, header, columns.size());
        std::vector<double> row;
        for (end = rows.end(); rows.next(row) && is_up_to(row[0], resume_after); ++n_rows)
          end = rows.end();
      }
    catch (const std::runtime_error &error)
      {
        throw InputError(std::string(error.what()) + ", so that the run cannot be continued in it. Were the probes "
                                                     "changed? Remove the file, or start without --restart.");
      }
    check();
    cut_file(csv_file, end);
    return true;
  }



  void
  History::add(const std::vector<double> &row, const unsigned int n_optional)
  {
    AssertThrow(!finished, dealii::ExcMessage("A finished history takes no rows."));
    AssertThrow(row.size() == columns.size(), dealii::ExcDimensionMismatch(row.size(), columns.size()));
    for (unsigned int c = 0; c + n_optional < row.size(); ++c)
      require_finite(row[c], [&]() {
        return csv_file + ", row " + std::to_string(n_rows + 1) + ", " + columns[0].first + " = " +
               number_to_field(row[0], digits_of_records) + ": <" + columns[c].first + ">";
      });

    for (unsigned int c = 0; c < row.size(); ++c)
      {
        if (c > 0)
          lines += ',';
        append_number(lines, row[c], digits_of_records);
      }
    lines += '\n';
    ++n_rows;

    if (lines.size() > longest_lines || std::chrono::steady_clock::now() - time_of_writing > longest_delay)
      write_lines();
  }



  void
  History::write_lines()
  {
    try
      {
        write_now(csv, lines, csv_file);
      }
    catch (const std::runtime_error &)
      {
        finished = true; // the destructor shall not try again what failed
        throw;
      }
    lines.clear();
    time_of_writing = std::chrono::steady_clock::now();
  }



  void
  History::flush(const bool wait)
  {
    if (finished)
      return;
    write_lines();
    if (wait)
      wait_for_disk(csv_file);
  }



  void
  History::finish()
  {
    if (finished)
      return;
    write_lines();
    finished = true; // before the attempt: the destructor shall not try again what failed
    csv.close();
    write_hdf5_file();
  }



  void
  History::write_hdf5_file() const
  {
    std::optional<NumberRows> rows;
    std::vector<double>       row;
    std::uint64_t             n_read = 0;

    write_hdf5(hdf5_file, columns, n_rows, [&](std::vector<std::vector<double>> &block) {
      if (!rows)
        rows.emplace(csv_file, header, columns.size());
      for (std::vector<double> &values : block)
        values.clear();
      for (; n_read < n_rows && block[0].size() < rows_a_block; ++n_read)
        {
          if (!rows->next(row))
            throw std::runtime_error(csv_file + " was changed while the analysis ran");
          for (unsigned int c = 0; c < row.size(); ++c)
            block[c].push_back(row[c]);
        }
    });
  }
} // namespace samara
