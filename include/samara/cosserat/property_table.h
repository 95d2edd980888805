#ifndef samara_cosserat_property_table_h
#define samara_cosserat_property_table_h

#include <map>
#include <string>
#include <vector>

namespace samara
{
  /**
   * A CSV file of properties along a beam, linear between its lines. The first line names the columns, with their
   * units:
   *
   *     s [in], EA [lbf], EI2 [lb*in^2], twist [deg]
   *
   * One column is the abscissa: `x` without a unit is relative, 0 at the start of the beam and 1 at its end; `x [m]`,
   * `s` and `r` are lengths, and `r/R` is a part of a radius. A column `chord` is for others. Two lines with the same
   * abscissa make a jump. Without a unit a number is in SI units; what stands behind # is left out.
   */
  struct PropertyTable
  {
    /** With the radius [m] of a column `r/R`; 0: none. @throws std::invalid_argument saying file, line and word. */
    explicit PropertyTable(const std::string &file, double radius = 0);

    bool                                       is_relative = true; ///< or the abscissae are lengths [m]
    std::vector<double>                        abscissae;          ///< ascending
    std::map<std::string, std::vector<double>> columns;            ///< by name; SI units
    std::vector<std::string>                   lines;              ///< of the file
    std::string                                file;

    /** A property at the abscissa @p x; at a jump seen from below, or from above. */
    double at(const std::string &column, double x, bool from_below) const;

  private:
    double                   radius = 0; ///< [m]
    std::vector<std::string> names;      ///< of the columns; the abscissa is ""
    std::vector<double>      factors; ///< to SI units

    void read_header(const std::string &line);
    void read_column(const std::string &cell, const std::string &where);
    void read_line(const std::string &line, const std::string &place);
  };
} // namespace samara

#endif
