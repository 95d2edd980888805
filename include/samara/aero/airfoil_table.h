#ifndef samara_aero_airfoil_table_h
#define samara_aero_airfoil_table_h

#include <samara/aero/airfoil.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * A coefficient over angles of attack from −π to π and Mach numbers, interpolated: in the angle by cubics with the
   * slopes of F. N. Fritsch & J. Butland (SIAM J. Sci. Stat. Comput. 5, 1984), so that it has one slope everywhere and
   * goes nowhere beyond its points; in the Mach number linearly, and constant outside the table. What is at −π and at π
   * has one slope, too.
   */
  class AirfoilTable
  {
  public:
    AirfoilTable() = default;

    /** @p values: a row for each of @p angles [rad], from −π to π, a column for each of @p machs; both increase. */
    AirfoilTable(const std::vector<double> &angles, const std::vector<double> &machs, const Eigen::MatrixXd &values);

    struct Value
    {
      double value = 0, alpha = 0, mach = 0; ///< with the derivatives
    };
    Value at(double alpha, double mach) const;

    /** The last Mach number; of a table that does not depend on it 0.9. */
    double
    highest_mach() const
    {
      return machs.size() > 1 ? machs.back() : 0.9;
    }

  private:
    std::vector<double> angles, machs;
    Eigen::MatrixXd     values, slopes;
  };



  /** The three tables of an airfoil. */
  struct AirfoilTables
  {
    AirfoilTable lift, drag, moment;
  };

  /** What is done with tables that do not reach from −180° to 180°. */
  enum class Beyond
  {
    refuse,  ///< an error
    constant ///< the coefficients stay what they are at the last angles
  };

  /**
   * @name Readers
   * of the @p text of a file of this name, with which messages begin: "file:line: ...".
   * @throws std::invalid_argument where numbers are missing, angles or Mach numbers do not increase, angles are beyond
   * ±180° or, as @p beyond says, do not reach them.
   * @{
   */
  /**
   * C81: a name in columns 1 to 30, then six numbers of two columns, of Mach numbers and angles of the tables of lift,
   * drag and moment; each table: Mach numbers in columns of 7 from column 8, nine a line, then for each angle [deg] the
   * angle in columns 1 to 7 and the values behind it, continued in lines with 7 blanks. Or free: a first line "# FREE
   * FORMAT", then "name; six numbers", then all numbers with blanks between them, the Mach numbers of a table before
   * its rows of angle and values.
   */
  AirfoilTables read_c81(const std::string &text, const std::string &name, Beyond beyond);

  /**
   * Polars of AeroDyn 15: lines "value keyword", of which NumTabs and NumAlf count, then rows of angle
   * [deg], c_l, c_d and, if there is a fourth column, c_m. Of several tables, for several Reynolds numbers, the one
   * @p which is taken, the first one 1.
   */
  AirfoilTables read_aerodyn(const std::string &text, const std::string &name, Beyond beyond, unsigned int which);
  /** @} */



  /** Coefficients measured or computed elsewhere, in a file. */
  class TabulatedAirfoil : public Airfoil
  {
  public:
    void         add_parameters(Parameters &prm) override;
    void         initialize(Model &model) override;
    Coefficients at(double alpha, double mach) const override;
    double       highest_mach() const override;

  protected:
    virtual AirfoilTables read(const std::string &text) const = 0;

    std::string file;

    Beyond
    beyond() const
    {
      return beyond_text == "refuse" ? Beyond::refuse : Beyond::constant;
    }

  private:
    std::string   beyond_text = "refuse";
    AirfoilTables tables;
  };



  class C81Airfoil : public TabulatedAirfoil
  {
  protected:
    AirfoilTables
    read(const std::string &text) const override
    {
      return read_c81(text, file, beyond());
    }
  };



  class AeroDynAirfoil : public TabulatedAirfoil
  {
  public:
    void add_parameters(Parameters &prm) override;

  protected:
    AirfoilTables
    read(const std::string &text) const override
    {
      return read_aerodyn(text, file, beyond(), which);
    }

  private:
    unsigned int which = 1;
  };
} // namespace samara

#endif
