#include <samara/output/file.h>
#include <samara/output/plain_hdf5.h>
#include <samara/output/write_hdf5.h>

#include <deal.II/base/exceptions.h>

#include <cerrno>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

namespace samara
{
  namespace
  {
    using Columns = std::vector<std::pair<std::string, std::string>>;



    /** Throw why the last attempt to write failed. */
    [[noreturn]] void
    fail_to_write()
    {
      throw std::runtime_error(errno != 0 ? std::generic_category().message(errno) : "the file does not take it");
    }



    void
    write_all(std::ofstream                                                 &stream,
              const Columns                                                 &columns,
              const std::uint64_t                                            n_rows,
              const std::function<void(std::vector<std::vector<double>> &)> &next_block)
    {
      PlainHdf5                                          file;
      std::set<std::string>                              names;
      std::vector<std::pair<unsigned int, unsigned int>> datasets; // of columns
      for (unsigned int c = 0; c < columns.size(); ++c)
        if (names.insert(columns[c].first).second)
          datasets.emplace_back(c,
                                file.add(columns[c].first, PlainHdf5::Kind::real, n_rows, "unit", columns[c].second));

      const auto write = [&](const char *from, const std::size_t size) {
        errno = 0;
        if (!stream.write(from, size))
          fail_to_write();
      };
      const std::string head = file.head();
      write(head.data(), head.size());
      std::vector<std::vector<double>> block(columns.size());
      for (std::uint64_t row = 0; row < n_rows; row += block[0].size())
        {
          next_block(block);
          for ([[maybe_unused]] const auto &column : block)
            AssertDimension(column.size(), block[0].size());
          Assert(!block[0].empty() && block[0].size() <= n_rows - row, dealii::ExcMessage("A block beyond the rows."));
          for (const auto &[column, dataset] : datasets)
            {
              // columns stand one behind the other: in one block they are written in a row
              if (block[0].size() < n_rows)
                stream.seekp(file.place(dataset) + sizeof(double) * row);
              write(reinterpret_cast<const char *>(block[column].data()), sizeof(double) * block[column].size());
            }
        }
      errno = 0;
      stream.close();
      if (!stream)
        fail_to_write();
    }
  } // namespace



  void
  write_hdf5(const std::string                                             &file,
             const Columns                                                 &columns,
             const std::uint64_t                                            n_rows,
             const std::function<void(std::vector<std::vector<double>> &)> &next_block)
  {
    try
      {
        errno = 0;
        std::ofstream stream(part_of(file), std::ios::binary);
        if (!stream)
          fail_to_write();
        write_all(stream, columns, n_rows, next_block);
      }
    catch (const std::runtime_error &error)
      {
        std::error_code ignored;
        std::filesystem::remove(part_of(file), ignored);
        throw std::runtime_error("cannot write " + file + ": " + error.what() + ".");
      }
    replace_by_part(file);
  }
} // namespace samara
