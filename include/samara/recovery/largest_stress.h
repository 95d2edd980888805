#ifndef samara_recovery_largest_stress_h
#define samara_recovery_largest_stress_h

#include <samara/cosserat/beam.h>
#include <samara/section/recovery.h>

namespace samara
{
  /**
   * Where along a beam, and when, its sections are nearest to failure: an index of section/recovery.h is looked at in
   * each state that look() is given, at the ends and in the middle of all elements, at a jump on both sides.
   */
  class LargestStress
  {
  public:
    /**
     * @param criterion max stress, Tsai-Wu, Hashin, von Mises, or "largest" of those that are known
     */
    LargestStress(const Beam &beam, const std::string &criterion)
      : beam(beam)
      , criterion(criterion)
    {}

    /** @throws std::invalid_argument if a section has no stresses, or strengths are missing that the criterion needs */
    void look(const State &state);

    struct Found
    {
      double        time = 0;
      double        x    = 0; ///< relative abscissa
      double        index;
      Beam::Station there;
    };
    std::optional<Found> found; ///< nothing before the first look
    double               first_time = 0, last_time = 0;

    const Beam &beam;

  private:
    struct Place
    {
      double                              x, inside;
      std::shared_ptr<const BeamStresses> stresses;
    };
    std::vector<Place> places;
    std::string        criterion;

    double index_of(const FailureIndices &indices) const;
    void   find_places(const State &state);
  };
} // namespace samara

#endif
