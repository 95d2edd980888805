#ifndef samara_analysis_skeleton_h
#define samara_analysis_skeleton_h

#include <samara/analysis/analysis.h>
#include <samara/output/table.h>

#include <optional>

namespace samara
{
  /**
   * An analysis to copy; doc/how_to/analysis.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * Mass, centre of mass and inertia of the whole model in the state reached, in inertial axes; the inertia about the
   * centre or about a point that is named. Writes mass.csv with a line for each of the rotor speeds of a sweep.
   *
   * The state stays as it is. @throws InputError for a point that is not there.
   */
  class MassReport : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void start(Context &context) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    System::MassProperties last; ///< found; the inertia is about the point that was asked for

  private:
    std::string          about;
    std::optional<Table> table;
  };
} // namespace samara

#endif
