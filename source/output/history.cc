#include <samara/output/file.h>
#include <samara/output/history.h>
#include <samara/output/write_hdf5.h>

#include <deal.II/base/exceptions.h>

#include <exception>
#include <iostream>

namespace samara
{
  namespace
  {
    constexpr unsigned int digits_in_histories = 15;
  }



  History::History(const std::string                                      &folder,
                   const std::string                                      &name,
                   const std::vector<std::pair<std::string, std::string>> &columns)
    : folder(folder)
    , name(name)
    , columns(columns)
    , values(columns.size())
  {
    make_folder(folder);
    const std::string file = folder + "/" + name + ".csv";
    csv                    = open_file(file);

    std::vector<std::string> header;
    for (const auto &[column, unit] : columns)
      header.push_back(unit.empty() || unit == "1" ? column : column + " [" + unit + "]");
    csv << csv_line(header);
    flush(csv, file);
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



  void
  History::add(const std::vector<double> &row)
  {
    AssertThrow(!finished, dealii::ExcMessage("A finished history takes no rows."));
    AssertThrow(row.size() == columns.size(), dealii::ExcDimensionMismatch(row.size(), columns.size()));

    std::vector<std::string> fields;
    for (unsigned int c = 0; c < row.size(); ++c)
      {
        fields.push_back(number_to_field(row[c], digits_in_histories));
        values[c].push_back(row[c]);
      }
    csv << csv_line(fields);
    flush(csv, folder + "/" + name + ".csv");
  }



  void
  History::finish()
  {
    if (finished)
      return;
    finished = true; // before the attempt: the destructor shall not try again what failed
    csv.close();
    write_hdf5(folder + "/" + name + ".h5", columns, values);
  }
} // namespace samara
