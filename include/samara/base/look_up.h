#ifndef samara_base_look_up_h
#define samara_base_look_up_h

#include <samara/base/jet.h>
#include <samara/base/units.h>

#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /**
   * A function of one or two variables that a CSV file tabulates; in expressions
   *
   *     table("spring.csv", x)                linear between the rows
   *     table("spring.csv", x, cubic)         monotone cubic, with a continuous slope
   *     table("polar.csv: drag", x, y)        bilinear
   *
   * The first column, or the first two, are x and y, one column is the value: the only other one, or the one that is
   * named after a colon. The first line may name the columns, with units in brackets, "stretch [mm], pull [kN]"; a
   * column without a unit is in SI units, and a pure number where dimensions are checked. Of one variable x increases
   * from row to row. Of two the rows are all combinations of some x and some y, in any order.
   *
   * Beyond its ends the table keeps the value that it has there.
   *
   * The cubic is that of Fritsch & Butland (SIAM J. Sci. Stat. Comput. 5, 1984): slopes in the rows are weighted
   * harmonic means of those beside them, zero where these differ in sign, so that it is monotone where the rows are and
   * goes nowhere beyond them.
   */
  class LookUp
  {
  public:
    /**
     * Read the file; what is read is shared with those who have it now.
     * @throws std::invalid_argument with the place in the file, if it cannot be read
     */
    static std::shared_ptr<const LookUp>
    of_file(const std::string &file_and_column, unsigned int n_arguments, bool cubic);

    /** The same of a text, @p name stands in messages. */
    LookUp(const std::string &text,
           const std::string &name,
           const std::string &column,
           unsigned int       n_arguments,
           bool               cubic);

    unsigned int
    n_arguments() const
    {
      return axes.size();
    }

    /** The value in SI units for arguments in SI units, with derivatives. */
    Jet operator()(const Jet *arguments) const;

    /** A number for the piece that it is on, between jumps of the slope: of a cubic these are at its ends only. */
    double piece(const Jet *arguments) const;

    /** Where the slope by an argument jumps. */
    std::vector<double> corners(unsigned int argument) const;

    /** What the columns are: those of the arguments first, then that of the value. */
    const std::vector<Dimension> &
    dimensions() const
    {
      return units;
    }

  private:
    std::vector<std::vector<double>> axes;   ///< increasing, in SI units
    std::vector<double>              values; ///< the last argument runs fastest
    std::vector<double>              slopes; ///< of a cubic
    std::vector<Dimension>           units;

    void read_rows(const std::vector<std::vector<double>> &rows, const std::string &name);
    void find_slopes();

    Jet of_one(const Jet &x) const;
    Jet of_two(const Jet &x, const Jet &y) const;
  };
} // namespace samara

#endif
