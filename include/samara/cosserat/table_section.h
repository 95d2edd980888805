#ifndef samara_cosserat_table_section_h
#define samara_cosserat_table_section_h

#include <samara/cosserat/section_stations.h>

#include <map>
#include <memory>

namespace samara
{
  /**
   * Properties linear between stations: other sections at abscissae, or files of engineering constants, each with
   * stations of its own (PropertyTable). Abscissae are relative or lengths; of a table with lengths each beam has its
   * own part, from "Start" on. Complains about tables that cannot be; whether they reach along a beam, this beam says.
   */
  class TableSection : public Section
  {
  public:
    void           add_parameters(Parameters &prm) override;
    void           initialize(Model &model) override;
    const Section &along(double length) const override;
    bool           has_twist() const override;

    /** @name Of a table with relative abscissae, which fits all beams. @throws std::invalid_argument if it does not @{
     */
    SectionValues                at(double x, const Vector3 &curvature) const override;
    bool                         depends_on_curvature() const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;
    std::vector<StressedSection> stressed(double x, double inside) const override;
    std::vector<double>          kinks() const override;
    /** @} */

    /** What was read from the files, if there are some. */
    std::vector<std::string> lines_of_files() const;

  private:
    std::string                           file_names;
    std::vector<std::string>              station_texts, files;
    double                                start = 0, radius = 0; ///< [m]
    std::vector<SectionStations::Station> stations;           ///< with x [m] if they are not relative
    bool                                  is_relative = true; ///< the stations
    std::vector<PropertyTable>            tables;

    mutable std::map<double, std::unique_ptr<const SectionStations>> made; ///< by the length of a beam

    void           read_stations(Model &model);
    void           read_files();
    bool           fits_all_beams() const;
    const Section &of_all_beams() const;

    /** The stations for a beam of that length; throws as along() does. */
    std::unique_ptr<const SectionStations> make(double length) const;
  };
} // namespace samara

#endif
