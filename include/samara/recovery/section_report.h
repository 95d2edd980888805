#ifndef samara_recovery_section_report_h
#define samara_recovery_section_report_h

#include <samara/analysis/analysis.h>
#include <samara/cosserat/analysed_section.h>
#include <samara/recovery/largest_stress.h>
#include <samara/report/report_page.h>

namespace samara
{
  /**
   * The analysis `section`: what the sections of the model are, and the stresses in them at places of beams in the
   * state reached. A model of sections alone needs no body.
   *
   * Writes sections.csv and .h5, a line each, section_<name>.txt with all matrices, for people and for sections of type
   * `file`, and pictures: section_<name>.vtu with materials, fibres and warping, stresses_<beam>_<place>.vtu with
   * stresses and failure indices, stresses.csv with the largest ones, stresses_of_plies.csv with those of each layer;
   * <beam>_beamdyn.dat of beams that are named.
   */
  class SectionReport : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void run(Context &context) override;

    bool
    needs_bodies() const override
    {
      return false;
    }
    /** @throws InputError if stresses are wanted, which beams have. */
    void run_without_bodies(const Model &model, const std::string &folder, bool pictures, Log &log) override;

    /** Where sections are shown, too, of a model without bodies, which has no context; null: nowhere. */
    ReportPage *page = nullptr;

    /** Before a run: look at the motions among @p analyses that come before this one, if there is something to see. */
    void watch(const Model &model, const std::vector<std::unique_ptr<Analysis>> &analyses);

  private:
    std::vector<std::string> names, places, beamdyn_beams, names_of_watched;
    std::string              criterion = "largest";

    std::vector<std::shared_ptr<LargestStress>> watched;
    bool                                        sees_motion = false;

    std::vector<const Section *> wanted(const Model &model) const;
    void report(const Model &model, const std::string &folder, bool pictures, ReportPage *page, Log &log) const;
    void                         write_beamdyn_files(const Context &context) const;
    void                         look(const State &state);
    void                         report_stresses(const Context &context);

    /** A place of a beam whose stresses are wanted. */
    struct StressedPlace
    {
      std::string   name; ///< "blade at 0.3"
      std::string   file; ///< the name of its picture
      Beam::Station there;
      double        time;
    };
    static StressedPlace place_named(const std::string &place, const Context &context);
    void                 tell_stresses(const Context &context, const std::vector<StressedPlace> &wanted) const;
  };



  /** @name Files for ParaView, in the axes 1, 2, 3 as x, y, z @{ */
  /** The section with materials, fibres and the warping of unit section forces. */
  std::string picture_of(const SectionAnalysis &analysis);

  /** Stresses and failure indices, at the place @p x with section axes @p D. */
  std::string picture_of_stresses(const SectionAnalysis &analysis,
                                  const Vector6         &forces,
                                  double                 helix,
                                  const Vector3         &x,
                                  const Matrix3         &D);
  /** @} */

  /** The same for the page of a report, flat. @{ */
  Drawing drawing_of(const SectionAnalysis &analysis, const std::string &name);
  Drawing
  drawing_of_stresses(const SectionAnalysis &analysis, const Vector6 &forces, double helix, const std::string &name);
  /** @} */
} // namespace samara

#endif
