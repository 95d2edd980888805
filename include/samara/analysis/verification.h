#ifndef samara_analysis_verification_h
#define samara_analysis_verification_h

#include <samara/analysis/analysis.h>
#include <samara/output/table.h>

namespace samara
{
  /**
   * Looks at the elements of a model as their writer should, in its reference configuration and in a random one near
   * it:
   *
   *   tangent, damping, rates    against complex steps through the residual and the strains, exact to round-off
   *   motions without strain     of an element or body: 6 of what is elastic and free, more of what has mechanisms
   *   change in rigid motion     of the strains when everything is moved and turned by 2 rad, over their size
   *   third difference           of the strains along a line in places and triads: 0 if they are quadratic, as they
   * must be for steps in time that keep energy to round-off
   *
   * The model should hang free: what is tied to the ground is strained by rigid motions. Writes verification.csv, a row
   * for each item that has strains. The state stays as it is.
   *
   * @throws NotConverged after the table has been written, if a derivative is wrong by more than the tolerance, or
   * strains change in a rigid motion: it names the unknowns or the item.
   * @throws InputError for models of more than 3000 unknowns: the matrices are full.
   */
  class VerificationAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void run(Context &context) override;

    /** What was found of an item. */
    struct Row
    {
      std::string  name, kind;
      unsigned int n_strains;
      unsigned int n_free_motions;   ///< without strain, of the nodes it depends on
      double       change_in_motion; ///< relative
      double       third_difference; ///< relative
    };
    std::vector<Row>         rows;
    std::vector<std::string> studies; ///< entry: files, run behind it by verification_studies.h
    double                   error_of_tangent = 0, error_of_damping = 0, error_of_rates = 0;

  private:
    double tolerance = 1e-9;

    void        check_derivatives(const System &system);
    void        look_at_items(const Context &context);
    void        write(const Context &context) const;
    std::string complaint() const;

    std::string worst_place; ///< of the derivatives, "row, column" by name
  };
} // namespace samara

#endif
