#include <samara/output/hdf5.h>
#include <samara/output/write_hdf5.h>

#include <deal.II/base/exceptions.h>

#include <set>

namespace samara
{
  namespace
  {
    using hdf5::check, hdf5::Handle;



    void
    write_block(const hid_t dataset, const hsize_t begin, const std::vector<double> &values)
    {
      const hsize_t size = values.size();
      const Handle  in_memory(H5Screate_simple(1, &size, nullptr), &H5Sclose);
      const Handle  in_file(H5Dget_space(dataset), &H5Sclose);
      check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &begin, nullptr, &size, nullptr));
      check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, values.data()));
    }



    void
    write_all(const hid_t                                                    file,
              const std::vector<std::pair<std::string, std::string>>        &columns,
              const std::uint64_t                                            n_rows,
              const std::function<void(std::vector<std::vector<double>> &)> &next_block)
    {
      std::set<std::string>                        names;
      std::vector<std::pair<unsigned int, Handle>> datasets;
      for (unsigned int c = 0; c < columns.size(); ++c)
        if (names.insert(columns[c].first).second)
          {
            datasets.emplace_back(c, hdf5::create_dataset(file, columns[c].first, H5T_NATIVE_DOUBLE, n_rows));
            hdf5::write_attribute(datasets.back().second, "unit", columns[c].second);
          }

      std::vector<std::vector<double>> block(columns.size());
      for (std::uint64_t row = 0; row < n_rows; row += block[0].size())
        {
          next_block(block);
          for ([[maybe_unused]] const auto &column : block)
            AssertDimension(column.size(), block[0].size());
          Assert(!block[0].empty() && block[0].size() <= n_rows - row, dealii::ExcMessage("A block beyond the rows."));
          for (const auto &[column, dataset] : datasets)
            write_block(dataset, row, block[column]);
        }

      for (auto &column_and_dataset : datasets)
        column_and_dataset.second.close();
    }
  } // namespace



  void
  write_hdf5(const std::string                                             &file,
             const std::vector<std::pair<std::string, std::string>>        &columns,
             const std::uint64_t                                            n_rows,
             const std::function<void(std::vector<std::vector<double>> &)> &next_block)
  {
    hdf5::write_file(file, [&](const hid_t part) { write_all(part, columns, n_rows, next_block); });
  }
} // namespace samara
