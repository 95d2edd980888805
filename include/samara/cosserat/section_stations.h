#ifndef samara_cosserat_section_stations_h
#define samara_cosserat_section_stations_h

#include <samara/cosserat/property_table.h>
#include <samara/cosserat/section_loft.h>

namespace samara
{
  /**
   * What a table says along a beam of a certain length, between stations at relative abscissae: the shape is linear
   * where both stations are of one kind (Section::loft_to), elsewhere stiffness and inertia are, as matrices. Two
   * stations at the same abscissa make a jump.
   */
  class SectionStations : public Section
  {
  public:
    struct Station
    {
      double         x       = 0;       ///< relative abscissa, perhaps beyond the beam
      const Section *section = nullptr; ///< that is there; null if its values are given
      SectionValues  values  = {};
      double         twist   = 0; ///< [rad]
    };

    /**
     * All stations of some tables. @p start [m] is the abscissa of the start of the beam in those that have lengths.
     * @throws std::invalid_argument if the tables do not reach from the start of the beam to its end
     */
    SectionStations(const std::vector<PropertyTable> &tables, double start, double length);

    /** Stations in ascending order. @throws std::invalid_argument as the other one does */
    explicit SectionStations(const std::vector<Station> &stations);

    SectionValues                at(double x, const Vector3 &curvature) const override;
    SectionValues                at_side(double x, double inside, const Vector3 &curvature) const override;
    bool                         depends_on_curvature() const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;
    std::vector<StressedSection> stressed(double x, double inside) const override;
    std::vector<double>          kinks() const override;
    bool                         has_twist() const override;
    double                       twist(double x, double inside) const override;
    std::vector<double>          jumps_of_twist() const override;

    /** What is not physical about given values of the section @p what, and where; "" if nothing is. */
    std::string fault(const std::string &what) const;

  private:
    struct Between
    {
      std::unique_ptr<const SectionLoft> loft; ///< null: they are not of one kind
    };

    std::vector<Station>                    stations;
    mutable std::map<unsigned int, Between> made; ///< by the station before

    /** The sections between a station and the next one, if they are of one kind. */
    const SectionLoft *between(unsigned int station) const;

    /** The station before @p x and the weight of the one behind it; at a jump on the side of @p inside. */
    std::pair<unsigned int, double> piece(double x, double inside) const;
  };
} // namespace samara

#endif
