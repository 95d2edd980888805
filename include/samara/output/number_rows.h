#ifndef samara_output_number_rows_h
#define samara_output_number_rows_h

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace samara
{
  /**
   * Reads the rows of numbers below the header of a CSV file, one after the other, however many there are. A last line
   * without an end, cut off when a run was killed, does not count. What is not as it should be is a std::runtime_error
   * that begins with the name of the file and ends without a full stop: who reads knows what to do about it.
   */
  class NumberRows
  {
  public:
    /** @p header is the line with its end that the file begins with. */
    NumberRows(const std::string &file, const std::string &header, unsigned int n_columns);

    /** Read a row, a number a column; false if there is none. */
    bool next(std::vector<double> &row);

    /** How many bytes of the file have been read, header included. */
    std::uintmax_t
    end() const
    {
      return bytes;
    }

  private:
    const std::string  file;
    const unsigned int n_columns;
    std::ifstream      in;
    std::string        line;
    std::uintmax_t     bytes = 0, rows = 0;
  };
} // namespace samara

#endif
