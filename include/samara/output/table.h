#ifndef samara_output_table_h
#define samara_output_table_h

#include <initializer_list>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace samara
{
  /**
   * A small table with a header, of numbers and words, for a CSV file and for the terminal:
   *
   *     Table table({"mode", "frequency [Hz]", "shape"});
   *     table.add_row({1, 3.52, "flap"});
   *     table.write("results/modes.csv");
   *     table.print(std::cout);
   */
  class Table
  {
  public:
    /** A number or a text. Numbers stay numbers until they are written: files get more digits than the terminal. */
    struct Cell
    {
      template <typename Number, typename = std::enable_if_t<std::is_arithmetic<Number>::value>>
      Cell(const Number number)
        : number(static_cast<double>(number))
        , is_number(true)
      {}

      Cell(const std::string &text)
        : text(text)
      {}

      Cell(const char *text)
        : text(text)
      {}

      /** A number that may be missing: nan. */
      static Cell
      optional(const double number)
      {
        Cell cell(number);
        cell.is_optional = true;
        return cell;
      }

      std::string text;
      double      number      = 0;
      bool        is_number   = false;
      bool        is_optional = false;
    };

    const std::vector<std::string> columns;

    explicit Table(const std::vector<std::string> &columns);

    /** One cell a column. @throws NotConverged naming row and column if a number is not finite and not optional. @{ */
    void add_row(std::initializer_list<Cell> cells);

    template <typename T>
    void
    add_row(const std::vector<T> &cells)
    {
      append(std::vector<Cell>(cells.begin(), cells.end()));
    }
    /** @} */

    /** As CSV with 12 significant digits. Throws a std::runtime_error with the name of the file if that fails. */
    void write(const std::string &file) const;

    /** In aligned columns, with 6 significant digits. */
    void print(std::ostream &out) const;

  private:
    void append(std::vector<Cell> cells);

    std::vector<std::vector<Cell>> rows;
  };
} // namespace samara

#endif
