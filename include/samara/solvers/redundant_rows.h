#ifndef samara_solvers_redundant_rows_h
#define samara_solvers_redundant_rows_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>

namespace samara
{
  /**
   * Constraints that repeat what others say (doc/theory/redundant.md). Of the m rows of G, d depend on the others in
   * every position. State::left_out names d rows that are left out, their multipliers zero; as long as the combinations
   *
   *     Gᵀ X = 0  (X: m × d),   X = 1 on the rows left out
   *
   * have no entry of more than 2, the choice is good; else rows are exchanged. Rows are scaled to |row of G| = 1, with
   * lengths divided by the size ℓ of the model. Rows i with X_i = 0 have unique multipliers, the others have not.
   */
  class RedundantRows
  {
  public:
    explicit RedundantRows(const System &system);

    /**
     * The rows to leave out, found from nothing. What is dependent in the position of @p state, but no longer after a
     * small motion along its velocity (or any, if it is at rest), is not redundant.
     */
    std::vector<unsigned int> find(const State &state);

    /**
     * Look whether the rows left out are a good choice still, once something has moved by a tenth of a radian or of the
     * model's size (up to five times as far while the combinations change slowly), and exchange those that are not:
     * forces of constraints stay the same. A row that no longer depends on others is taken in again. Returns whether
     * the choice has changed. At singular positions it stays.
     */
    bool choose(State &state);

    /** All rows that depend on others in the position of the state, at a singular position more than are redundant. */
    std::vector<unsigned int> dependent_here(const State &state);

    /** X in the position of the state, of the rows as they are, with the choice it has. One row for each multiplier. */
    Eigen::MatrixXd combinations(const State &state);

    /** Of the multipliers of this state those of least norm, in N and N m/ℓ, that do the same. */
    void make_least(State &state);

    /** The value of a row as a length: of angles ℓ times them [m]. */
    double
    scaled(const unsigned int row, const double value) const
    {
      return scale[row] > 0 ? scale[row] * value : value;
    }

    /** Largest violations as lengths [m]. */
    struct Gaps
    {
      double       kept = 0, left_out = 0;
      unsigned int worst = 0; ///< of the rows left out
    };

    /** Of the constraints, values @p g of unknowns and multipliers as of System::add_gaps(). */
    Gaps gaps(const State &state, const std::vector<double> &g) const;
    Gaps gaps(const State &state) const;

    /**
     * What to say where rows left out do not hold: nothing as long as that comes from round-off or from rounded places
     * and axes, by the measure of the reference position. Else the rows that contradict each other, or that say the
     * same in one position only. To be asked after choose().
     */
    std::string objection(const State &state, const Gaps &gaps);

    /** Whether objection() has none, seen by the gaps alone: by far most states. */
    bool are_explained(const Gaps &gaps) const;

    /** The columns of X that prescribed motions cannot obey. */
    std::vector<int> contradictions(const State &state);

    /** A place a little further on, where only what is redundant everywhere is dependent; known after find(). */
    const State &
    generic_place() const
    {
      return generic;
    }

    /** Names of the rows with entries in column @p j of @p X, gathered by joint: "joint foot (displacement 2, rotation
     * 1)". */
    std::string names(const Eigen::MatrixXd &X, int j) const;

    /** Joints (and what else has rows) that share combinations, with the number of their redundant rows. */
    struct Loop
    {
      std::vector<const Item *> joints;
      unsigned int              n_redundant = 0;
    };
    std::vector<Loop> loops(const Eigen::MatrixXd &X) const;

    /** Look at the choice again, whatever has moved. */
    void
    forget()
    {
      checked = {};
    }

    unsigned int n_checks = 0, n_exchanges = 0; ///< for reports

  private:
    /** Combinations have larger entries at singular positions only: nothing can be said there. */
    static constexpr double singular = 1e5;

    /** Rows nearer than this to the span of others repeat them, but for round-off. */
    static constexpr double exact = 1e-7;

    const System                  &system;
    const int                      n, m; ///< kinematic unknowns, multipliers
    double                         length;
    SparseMatrix                   K;
    std::shared_ptr<const Pattern> pattern;
    std::vector<int>               kept; ///< entries of the saddle matrix among those of K
    std::unique_ptr<SparseMatrix>  saddle;
    std::unique_ptr<LinearSolver>  solver;
    std::vector<unsigned int>      left_out_of_pattern, left_out_of_X; ///< whose they are
    std::vector<double>            unit, scale;  ///< roots of the weights of unknowns; 1/|row|, 0 without one
    std::vector<bool>              is_absent;    ///< rows that say nothing, and need not be left out
    Eigen::MatrixXd                X;            ///< scaled
    std::vector<std::vector<int>>  rows_of;      ///< of each column of X: entries that are not negligible
    std::vector<bool>              is_full;      ///< columns with other entries, too, which are
    std::vector<double>            independence; ///< of each row left out: distance from the span of those kept
    std::vector<double>            no_multipliers;
    State                          checked;         ///< where the choice was looked at last
    double                         next_motion = 0; ///< how far from there to the next look [rad, or of the length]
    State                          generic;

    /** How far the rows left out are from repeating others where the model is given. */
    struct Rounding
    {
      bool   is_known     = false;
      double independence = 0, gap = 0; ///< distance from the span of those kept [1]; violation where those hold [m]
    };
    Rounding rounding;

    /** Gaps that Newton's method leaves; and those that rounded geometry may make beside. */
    double round_off_of(const Gaps &gaps) const;
    double allowed(const Gaps &gaps) const;
    void   measure_rounding(const State &state);
    void   assemble(const State &state);
    void   factorize(const std::vector<unsigned int> &left_out);
    void   find_combinations(const std::vector<unsigned int> &left_out);
    void   find_combination(const std::vector<unsigned int> &left_out, int j);
    /** Those of a group of columns by one solution, as no row had a part in two of them when they were found last. */
    void find_together(const std::vector<unsigned int> &left_out, const std::vector<int> &group);
    std::vector<std::vector<int>> columns_apart() const;
    /** Find the entries of a column that are not negligible. */
    void find_rows_of(int j);
    /** Entries of X that are not negligible, and where they are. */
    struct Entries
    {
      std::vector<std::vector<int>>    rows;
      std::vector<std::vector<double>> values;
    };
    Entries entries() const;
    struct Entry
    {
      double size = 0;
      int    row = 0, column = 0;
    };
    Entry largest_entry() const;
    /** Add the scaled row of G to a sum. */
    void add_row(int i, double factor, double *sum) const;
    bool exchange(std::vector<unsigned int> &left_out);
    /** Leave out row @p i instead of the one of column @p j. */
    void swap(std::vector<unsigned int> &left_out, int i, int j);
    /** Whether no entry of the combinations would be too large then. */
    bool is_good_swap(int i, int j) const;
    /** Of choices that are equally good one that leaves fewer rows to joints that have many: factors are sparser. */
    void                      spread(std::vector<unsigned int> &left_out);
    bool                      is_certainly_independent();
    std::vector<unsigned int> dependent_rows();
    void                      take_in_independent(std::vector<unsigned int> &left_out);
    /** To where the rows kept hold. */
    void  close(State &state, const std::vector<unsigned int> &left_out);
    State moved(const State &state, const std::vector<unsigned int> &left_out);
    /** How far from where the choice was looked at last; no number if it was another one. */
    double motion_since_look(const State &state) const;
    /** How far the combinations may be trusted, as they were @p before and have changed over a @p motion. */
    double motion_until_next(const Entries &before, double motion) const;
    void   keep_forces(State &state, const std::vector<unsigned int> &left_out) const;
  };
} // namespace samara

#endif
