#ifndef samara_study_study_quantity_h
#define samara_study_study_quantity_h

#include <string>
#include <vector>

namespace samara
{
  /** Numbers over something: time, a load factor. */
  struct Series
  {
    std::vector<double> x, y;

    /**
     * Between its points by the polynomial through the six nearest, so that a reference at other times than a run does
     * not hide the order of the run. Throws a std::runtime_error outside of its range.
     */
    double at(double place) const;
  };

  /** The number that stands for a series: its `final` value, the `largest` absolute one, or the `RMS` over x. */
  double norm_of(const Series &series, const std::string &norm);

  /** The norm of series − reference, at the places of @p series. */
  double distance(const Series &series, const Series &reference, const std::string &norm);



  /** What a study looks at in the results of its members: "dynamic: tip.displacement y". */
  struct StudyQuantity
  {
    std::string  source; ///< static, dynamic, energy, modal or floquet
    std::string  name;   ///< of a probe, an energy, or of what a mode has
    unsigned int mode = 0;

    StudyQuantity() = default;

    /** Read the text above. Throws std::invalid_argument with the nearest source that there is. */
    explicit StudyQuantity(const std::string &text);

    /** What a member must be told beyond its own overrides, so that the quantity is in its results. */
    std::vector<std::string> overrides() const;

    /** The analysis that gives it: static, dynamic, modal, floquet. */
    std::string analysis() const;

    /** Whether it belongs to a mode, not to a probe. */
    bool
    is_of_modes() const
    {
      return source == "modal" || source == "floquet";
    }

    /** From the folder of a member's results. Throws a std::runtime_error that says what is missing. */
    Series read(const std::string &folder) const;
  };



  /**
   * Two columns of a CSV file, the first and the one called @p column, with or without its unit; of a file with two
   * columns only, the second. Throws a std::runtime_error with the name of the file.
   */
  Series read_series(const std::string &file, const std::string &column);
} // namespace samara

#endif
