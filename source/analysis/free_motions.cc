// Motions without strain that no constraint prevents. What can only be strained or move as one rigid body (beams) has
// six unknowns, however fine its mesh.

#include <samara/analysis/analysis.h>
#include <samara/analysis/check.h>
#include <samara/analysis/negative_directions.h>
#include <samara/base/dense.h>
#include <samara/base/text.h>
#include <samara/solvers/from_eigen.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/rigid_pieces.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /** Of the stiffness, it is added to the diagonal: only then the matrix of a free model has an inverse. */
    constexpr double shift = 1e-9;

    /** Of constraints, relative to D: in a loop of beams, rigid as they are here, some say the same as others. */
    constexpr double softness = 1e-6;

    /** More free motions are not counted: the search works with as many full vectors of @p n numbers. */
    int
    most_free_motions(const int n)
    {
      return n > 20000 ? 8 : 32;
    }

    /** Joints' motions are told by name in models of up to so many joints. */
    constexpr unsigned int few_joints = 1000;



    /**
     * The tangent K of the reference configuration, free of loads and of stress, in the unknowns of rigid pieces: of
     * beams only what moves them as a whole. Behind the n unknowns of the pieces stand the m multipliers.
     */
    class PieceMatrix
    {
    public:
      explicit PieceMatrix(const System &system);

      int n, m;

      const SparseMatrix &
      matrix() const
      {
        return *reduced;
      }

      /** ½ Σ eᵀ C e of the strain rates of the motion @p x of the pieces. */
      double strain_energy(const Eigen::VectorXd &x) const;

      /** Velocities of all unknowns of the system. */
      Eigen::VectorXd
      velocities(const Eigen::VectorXd &x) const
      {
        const auto y = pieces.velocities(x);
        return Eigen::Map<const Eigen::VectorXd>(y.data(), system.layout.of_multiplier(0));
      }

    private:
      const System                 &system;
      State                         state;
      RigidPieces                   pieces;
      std::unique_ptr<SparseMatrix> reduced;

      using Triplets = std::vector<Eigen::Triplet<double>>;

      void add_row_of_transfer(int j, Triplets &entries) const;
      void reduce(const SparseMatrix &K);
      void set(const Eigen::SparseMatrix<double> &A);
    };



    PieceMatrix::PieceMatrix(const System &system)
      : m(system.layout.n_multipliers)
      , system(system)
      , state(system.reference())
      , pieces(system, model_length(system.model))
    {
      n            = pieces.n_unknowns();
      state.held   = false;
      state.factor = 0;
      pieces.renew(state);
      SparseMatrix K(system.layout.pattern);
      system.add_tangent(state.point(), K, System::Part::between_pieces);
      reduce(K);
    }



    double
    PieceMatrix::strain_energy(const Eigen::VectorXd &x) const
    {
      const std::vector<double> velocity = pieces.velocities(x);
      std::vector<double>       y(6 * system.layout.n_nodes, 0.), rates(system.layout.n_strains);
      std::copy_n(velocity.begin(), y.size() - 6, y.begin() + 6);
      Point<double> point = state.point();
      point.y             = y.data();
      point.rates         = velocity.data() + system.layout.of_coordinate(0);
      system.strain_rates(point, rates.data());
      return system.strain_energy(rates.data(), System::Part::between_pieces);
    }



    /** Row @p j of T, the velocities of the system from those of the pieces. */
    void
    PieceMatrix::add_row_of_transfer(const int j, Triplets &entries) const
    {
      const int n_twists = system.layout.of_coordinate(0), n_kinematic = system.layout.of_multiplier(0);
      if (j >= n_kinematic)
        entries.emplace_back(j, n + j - n_kinematic, 1.);
      else if (j >= system.layout.of_state(0))
        return; // states are no motion
      else if (j >= n_twists)
        entries.emplace_back(j, pieces.column_of_coordinate(j - n_twists), pieces.coordinate_unit(j - n_twists));
      else if (const int column = pieces.column_of_node(1 + j / 6); column >= 0)
        for (int l = 0; l < 6; ++l)
          if (const double t = pieces.twist_of_node(1 + j / 6)(j % 6, l); t != 0)
            entries.emplace_back(j, column + l, t);
    }



    /** Tᵀ K T; of T only the rows that K has entries in. */
    void
    PieceMatrix::reduce(const SparseMatrix &K)
    {
      const Pattern              &pattern = *K.pattern;
      const int                   size    = system.size();
      Eigen::SparseMatrix<double> of_used(size, size), T(size, n + m);
      Triplets                    entries;
      for (int j = 0; j < size; ++j)
        {
          of_used.startVec(j);
          bool is_used = false;
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            if (K.values[k] != 0)
              {
                of_used.insertBack(pattern.rows[k], j) = K.values[k];
                is_used                                = true;
              }
          if (is_used)
            add_row_of_transfer(j, entries);
        }
      of_used.finalize();
      T.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SparseMatrix<double> KT = of_used * T;
      set(T.transpose() * KT);
    }



    /** With the whole diagonal, and the pattern made symmetric. */
    void
    PieceMatrix::set(const Eigen::SparseMatrix<double> &A)
    {
      Eigen::SparseMatrix<double> I(A.rows(), A.cols());
      I.setIdentity();
      const Eigen::SparseMatrix<double> At = A.transpose();
      reduced                              = from_eigen(A + 0. * At + 0. * I);
    }



    /** Names of the joints' motions, "flap 1 rotation", that change when the model moves by the small @p z. */
    std::vector<std::string>
    moving_joints(const System &system, const Eigen::VectorXd &z)
    {
      if (system.layout.joints.size() > few_joints)
        return {};
      const State         start = system.reference();
      State               moved = start;
      std::vector<double> step(system.size(), 0.);
      std::copy(z.data(), z.data() + z.size(), step.begin());
      system.update(moved, step);
      std::vector<std::string> names;
      double                   largest = 0;
      std::vector<double>      changes;
      for (const auto *c : system.layout.joints)
        for (const auto &name : c->probe_names())
          if (const auto probe = c->probe(name); probe && (probe->unit == "deg" || probe->unit == "m"))
            {
              names.push_back(c->name + " " + probe->name);
              changes.push_back(std::abs(probe->value(moved) - probe->value(start)) *
                                (probe->unit == "deg" ? M_PI / 180 : 1.));
              largest = std::max(largest, changes.back());
            }
      std::vector<std::string> moving;
      // a joint that moves by less than a thousandth of the one that moves most is not what the motion is about
      for (unsigned int i = 0; i < names.size(); ++i)
        if (changes[i] > 1e-3 * std::max(largest, 1e-3 * z.lpNorm<Eigen::Infinity>()))
          moving.push_back(names[i]);
      return moving;
    }



    /** What moves: up to four bodies, and joints if there are any that do. */
    std::string
    description(const System &system, const Eigen::VectorXd &z)
    {
      std::map<std::string, double> share;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        share[system.model.nodes[node].name] += z.segment<6>(system.layout.of_node(node)).squaredNorm();
      const auto  sorted = largest_first(share);
      std::string text;
      for (unsigned int k = 0; k < std::min<unsigned int>(4, sorted.size()); ++k)
        if (sorted[k].first > 1e-6 * sorted[0].first) // squares: a thousandth of the motion
          text += (text.empty() ? "" : ", ") + sorted[k].second;
      const auto joints = moving_joints(system, 1e-3 * z / z.lpNorm<Eigen::Infinity>());
      return text + (joints.empty() ? "" : " at " + join_some(joints));
    }



    /** "turning about (1, 0, 0)" or "along (0, 0, 1)": what the node does that moves most. */
    std::string
    direction(const System &system, const Eigen::VectorXd &z)
    {
      const double length  = model_length(system.model);
      Vector3      turn    = Vector3::Zero();
      Vector3      advance = Vector3::Zero();
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Matrix3 D = system.model.nodes[node].D;
          const Vector3 v = D * z.segment<3>(system.layout.of_node(node)),
                        w = D * z.segment<3>(system.layout.of_node(node) + 3);
          advance         = v.norm() > advance.norm() ? v : advance;
          turn            = w.norm() > turn.norm() ? w : turn;
        }
      const bool turns = turn.norm() * length > advance.norm();
      Vector3    unit  = (turns ? turn : advance).normalized();
      // a line has no sense: its largest component shall be positive
      Eigen::Index largest;
      unit.cwiseAbs().maxCoeff(&largest);
      unit *= unit(largest) < 0 ? -1. : 1.;
      for (int i = 0; i < 3; ++i)
        unit(i) = std::abs(unit(i)) < 5e-4 ? 0. : std::round(1000 * unit(i)) / 1000;
      return std::string(turns ? ", turning about " : ", along ") + "(" + short_text(unit(0)) + ", " +
             short_text(unit(1)) + ", " + short_text(unit(2)) + ")";
    }



    /** A basis of the same motions, each of which moves as little as possible. */
    Eigen::MatrixXd
    simplest_basis(const Eigen::MatrixXd &Z)
    {
      const PivotedQr qr(Z.transpose());
      Eigen::MatrixXd pivots(Z.cols(), Z.cols());
      for (int j = 0; j < Z.cols(); ++j)
        pivots.row(j) = Z.row(qr.column(j));
      return Z * inverse(pivots);
    }



    /** Inverse iteration on a block of vectors: motions that strain nothing stay, all others fade. */
    class Search
    {
    public:
      explicit Search(const PieceMatrix &pieces);

      /** Motions without strain among the first @p block found, one column each. */
      Eigen::MatrixXd free_motions(int block) const;

    private:
      const PieceMatrix            &pieces;
      const int                     n, m;
      SparseMatrix                  K;     ///< shifted
      Eigen::VectorXd               D;     ///< metric of motions
      Eigen::VectorXd               scale; ///< of constraints: 1/|row|
      std::unique_ptr<LinearSolver> solver;

      Eigen::MatrixXd iterated(int block) const;
    };



    Search::Search(const PieceMatrix &pieces)
      : pieces(pieces)
      , n(pieces.n)
      , m(pieces.m)
      , K(pieces.matrix())
      , D(n)
      , scale(Eigen::VectorXd::Zero(m))
      , solver(make_solver(K.pattern))
    {
      double largest = 0;
      for (int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(K.values[K.pattern->position(i, i)]));
      for (int i = 0; i < n; ++i)
        {
          double &diagonal = K.values[K.pattern->position(i, i)];
          D(i)             = diagonal > 1e-9 * largest ? diagonal : std::max(largest, 1.);
          diagonal += shift * D(i);
        }
      for (int j = 0; j < m; ++j)
        {
          double square = 0;
          for (int k = K.pattern->column_start[n + j]; k < K.pattern->column_start[n + j + 1]; ++k)
            if (K.pattern->rows[k] < n)
              square += K.values[k] * K.values[k] / D(K.pattern->rows[k]);
          scale(j)         = square > 0 ? 1. / std::sqrt(square) : 0.;
          double &diagonal = K.values[K.pattern->position(n + j, n + j)];
          diagonal -= square > 0 ? softness * square : diagonal == 0 ? 1. : 0.;
        }
      solver->factorize(K);
    }



    Eigen::MatrixXd
    Search::iterated(const int block) const
    {
      Eigen::MatrixXd       X    = Eigen::MatrixXd::NullaryExpr(n, block, [](const auto i, const auto j) {
        return std::sin(1. + 1.3 * i + 2.1 * j * i + 0.7 * j);
      });
      const Eigen::VectorXd root = D.cwiseSqrt();
      // inverse iteration: each makes free motions larger against the softest others by their stiffness over the shift
      for (unsigned int iteration = 0; iteration < 6; ++iteration)
        {
          const Eigen::MatrixXd B = D.asDiagonal() * X;
          std::vector<double>   b(n + m);
          for (int j = 0; j < block; ++j)
            {
              std::fill(b.begin(), b.end(), 0.);
              std::copy(B.col(j).data(), B.col(j).data() + n, b.begin());
              solver->solve(b.data());
              X.col(j) = Eigen::Map<Eigen::VectorXd>(b.data(), n);
            }
          // orthonormal in D
          X = root.cwiseInverse().asDiagonal() * orthonormal_columns(root.asDiagonal() * X);
        }
      return X;
    }



    Eigen::MatrixXd
    Search::free_motions(const int block) const
    {
      const Eigen::MatrixXd X = iterated(block);
      // Ritz vectors of the stiffness in the block, with violated constraints as stiff springs: where the block has
      // more columns than there are free motions, the others are round-off, which obeys no constraint
      Eigen::MatrixXd KX(n, block), GX(m, block);
      for (int j = 0; j < block; ++j)
        {
          std::vector<double> x(n + m, 0.), y(n + m);
          std::copy(X.col(j).data(), X.col(j).data() + n, x.begin());
          K.multiply(x.data(), y.data());
          KX.col(j) = Eigen::Map<Eigen::VectorXd>(y.data(), n) - shift * D.cwiseProduct(X.col(j));
          GX.col(j) = Eigen::Map<Eigen::VectorXd>(y.data() + n, m).cwiseProduct(scale);
        }
      const HermitianEigen<double> ritz = symmetric_eigen(X.transpose() * KX + GX.transpose() * GX);
      const Eigen::MatrixXd        Z    = X * ritz.vectors;
      std::vector<int>             zero;
      for (int j = 0; j < block; ++j)
        // relative to D: K has round-off of its stiff parts, and strains that are computed from the motion have less
        if (std::abs(ritz.values(j)) < 1e-8 && pieces.strain_energy(Z.col(j)) < 1e-14)
          zero.push_back(j);
      return Z(Eigen::all, zero);
    }



    /** Zᵀ A Z of a matrix @p A of the system. */
    Eigen::MatrixXd
    projected(const SparseMatrix &A, const Eigen::MatrixXd &Z)
    {
      Eigen::MatrixXd     AZ(Z.rows(), Z.cols());
      std::vector<double> x(A.pattern->size()), y(x.size());
      for (int j = 0; j < Z.cols(); ++j)
        {
          std::copy(Z.col(j).data(), Z.col(j).data() + Z.rows(), x.begin());
          A.multiply(x.data(), y.data());
          AZ.col(j) = Eigen::Map<Eigen::VectorXd>(y.data(), Z.rows());
        }
      return Z.transpose() * AZ;
    }



    /**
     * Combinations of the free motions @p Z without inertia or damping: no equation says how they move. Measured by
     * what the whole mass would have, moving with the model's length.
     */
    Eigen::MatrixXd
    massless_motions(const System &system, const double mass, const Eigen::MatrixXd &Z)
    {
      constexpr double none =
        1e-16; // of a wire, a radius of gyration of 1e-8 lengths: below are motions known to round-off
      const double length = model_length(system.model);
      SparseMatrix M(system.layout.pattern), C(system.layout.pattern);
      system.mass(M);
      State state  = system.reference();
      state.factor = 1;
      system.damping(state, C);
      Eigen::VectorXd metric = Eigen::VectorXd::Ones(Z.rows());
      for (int i = 0; i < Z.rows(); ++i)
        if (i < system.layout.of_state(0) && !system.layout.is_length(i))
          metric(i) = length * length;
      metric *= mass / std::max(1u, system.layout.n_nodes - 1);
      const Eigen::MatrixXd whole = Z.transpose() * metric.asDiagonal() * Z, damping = projected(C, Z);
      Eigen::MatrixXd       held = projected(M, Z);
      // there is no common measure of both: any damping counts
      if (const double most = damping.cwiseAbs().maxCoeff(); most > 0)
        held += whole.trace() / (most * most) * damping.transpose() * damping;
      const HermitianEigen<double> ritz = symmetric_eigen(held, whole);
      return Z * ritz.vectors.leftCols((ritz.values.array() < none).count());
    }
  } // namespace



  void
  find_free_motions(const System &system, ModelCheck &check)
  {
    const PieceMatrix pieces(system);
    const int         n = pieces.n;
    if (n == 0)
      return;
    const Search    search(pieces);
    int             block = std::min(n, 8);
    Eigen::MatrixXd motions;
    for (;; block = std::min(n, 2 * block))
      {
        motions = search.free_motions(block);
        if (motions.cols() < block || block == n || block >= most_free_motions(n))
          break;
      }
    check.n_free_motions = motions.cols();
    if (motions.cols() == 0)
      return;
    const Eigen::MatrixXd simple = simplest_basis(motions);
    for (int j = 0; j < simple.cols(); ++j)
      {
        check.shapes.push_back(pieces.velocities(simple.col(j)));
        check.free_motions.push_back(description(system, check.shapes.back()));
      }
    if (motions.cols() == block && block < n)
      check.free_motions.push_back("others, which are not counted");

    // a model for statics alone needs no mass
    if (!(check.mass.mass > 0))
      return;
    Eigen::MatrixXd Z(system.layout.of_multiplier(0), simple.cols());
    for (int j = 0; j < simple.cols(); ++j)
      Z.col(j) = check.shapes[j];
    const Eigen::MatrixXd massless = massless_motions(system, check.mass.mass, Z);
    for (int j = 0; j < massless.cols(); ++j)
      check.massless.push_back(description(system, massless.col(j)) + direction(system, massless.col(j)));
  }
} // namespace samara
