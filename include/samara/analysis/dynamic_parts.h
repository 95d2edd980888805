#ifndef samara_analysis_dynamic_parts_h
#define samara_analysis_dynamic_parts_h

#include <samara/analysis/dynamic.h>
#include <samara/model/probe_needs.h>
#include <samara/solvers/redundant_rows.h>

#include <array>

namespace samara
{
  /** Files of a run, and what time it is there. */
  struct DynamicAnalysis::Output
  {
    std::unique_ptr<History>       history, energies, steps;
    std::unique_ptr<Pictures>      pictures;
    std::unique_ptr<RedundantRows> redundant; ///< made when reactions are not unique
    double                         next_picture = 0, next_on_page = 0;
    bool                           is_massless  = false; ///< accelerations cannot be found; has been said
    ProbeNeeds                     needs;
    const bool                     has_air;  ///< loads of it, which have columns of their own
    State                          reported; ///< the last one

    /** @p last: the checkpoint that the run goes on from, or none. */
    Output(const Context &context, const DynamicAnalysis &analysis, double start, const Checkpoint *last);

    /**
     * What is seen of a @p state: reported as Projection::report() says, as far as probes look at it, or all of it. In
     * positions where that is not determined it is the integrator's, which is said once.
     */
    const State &report(const Context &context, const State &state, Projection &projection, bool with_all);

    /** The tables with their names, null where nothing is written. */
    std::array<std::pair<const char *, History *>, 3>
    tables() const
    {
      return {{{"dynamic", history.get()}, {"dynamic_energy", energies.get()}, {"dynamic_steps", steps.get()}}};
    }

    void
    flush(const bool wait)
    {
      for (const auto &[name, table] : tables())
        if (table != nullptr)
          table->flush(wait);
      if (pictures != nullptr)
        pictures->finish();
    }
  };



  /** All that computes steps and remembers something from one to the next. */
  struct DynamicAnalysis::Machinery
  {
    std::unique_ptr<Integrator>    integrator, halves; ///< of the steps, and of the second estimate if there is one
    std::unique_ptr<Stepper>       stepper;
    std::unique_ptr<Projection>    projection;
    std::unique_ptr<RedundantRows> redundant; ///< of integrators that do not watch rows left out by themselves
  };

  /** @throws NotConverged if rows left out do not hold */
  void require_rows_left_out(RedundantRows &rows, const State &state);

  /**
   * Whether what a budget misses at most, @p gap [J], is what Newton's method may leave in so many steps, of the largest
   * energy [J], or the round-off of the budget's terms, @p round_off_of_sum [J] a step.
   */
  bool account_closes(double gap,
                      double largest_energy,
                      double n_steps,
                      double newton_tolerance,
                      double round_off_of_sum);

  /**
   * How well the strain energy of a state is known [J]. A strain is the difference of terms Σ |B_ij| ζ_j as large as the
   * model: it has their round-off, and σ times that is missing of its energy, Σ w |σ| ε Σ |B| ζ. Of a stiff body that is
   * strained by 1e-4, this is 1e4 times the round-off of the energy itself.
   */
  double round_off_of_strain_energy(const System &system, const State &state);

  /** Of a run into this folder. */
  std::string checkpoint_file(const Context &context);
} // namespace samara

#endif
