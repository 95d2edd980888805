// What a debug build catches: errors of programmers, in each room that has preconditions. (A release does not look.)

#include <samara/cosserat/element_table.h>
#include <samara/rotation/rotation.h>
#include <samara/solvers/linear.h>
#include <samara/time/projection.h>

#include <deal.II/base/exceptions.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

#ifdef DEBUG

class Preconditions : public testing::Test
{
protected:
  Preconditions()
    : scene("prm/examples/revolute.prm")
    , system(scene.system)
    , state(system.reference())
    , K(system.layout.pattern)
  {
    dealii::deal_II_exceptions::disable_abort_on_exception();
  }
  ~Preconditions() override
  {
    dealii::deal_II_exceptions::enable_abort_on_exception();
  }

  Scene               scene;
  const System       &system;
  State               state;
  SparseMatrix        K;
  std::vector<double> r;
};



TEST_F(Preconditions, StatesBelongToTheSystem)
{
  EXPECT_NO_THROW(system.residual(state, state.stress, r));
  EXPECT_THROW(system.residual(state, {}, r), dealii::ExceptionBase);
  EXPECT_THROW(system.update(state, std::vector<double>(system.size() - 1, 0.)), dealii::ExceptionBase);
  state.multipliers.pop_back();
  EXPECT_THROW(system.residual(state, state.stress, r), dealii::ExceptionBase);
  EXPECT_THROW(system.tangent(state, K), dealii::ExceptionBase);
}



TEST_F(Preconditions, MatricesBelongToThePattern)
{
  SparseMatrix other(std::make_shared<Pattern>(*system.layout.pattern));
  EXPECT_NO_THROW(system.tangent(state, K));
  EXPECT_THROW(system.tangent(state, other), dealii::ExceptionBase);
  EXPECT_THROW(system.mass(other), dealii::ExceptionBase);
  EXPECT_THROW(K.add(1, other), dealii::ExceptionBase);
  EXPECT_THROW(K.pattern->position(0, K.pattern->size()), dealii::ExceptionBase);
}



TEST_F(Preconditions, BlocksAreFilledWhenTheLayoutIsComplete)
{
  Block           block;
  Eigen::MatrixXd local = Eigen::MatrixXd::Zero(6, 6);
  EXPECT_THROW(block.add(local, K), dealii::ExceptionBase);
}



TEST_F(Preconditions, FactorsComeBeforeSolutions)
{
  const auto          solver = make_solver(system.layout.pattern);
  std::vector<double> b(system.size(), 1.);
  EXPECT_THROW(solver->solve(b.data()), dealii::ExceptionBase);
  system.tangent(state, K);
  solver->factorize(K);
  EXPECT_NO_THROW(solver->solve(b.data()));
  EXPECT_THROW(solver->factorize(SparseMatrix(std::make_shared<Pattern>(*K.pattern))), dealii::ExceptionBase);
  // zero everywhere: no factors, and none of the matrix before
  EXPECT_THROW(solver->factorize(SparseMatrix(K.pattern)), SingularMatrix);
  EXPECT_THROW(solver->solve(b.data()), dealii::ExceptionBase);
}



TEST_F(Preconditions, VelocitiesHaveTheSizeOfTheSystem)
{
  Projection projection(system);
  state.y.pop_back();
  EXPECT_THROW(projection.velocities(state), dealii::ExceptionBase);
}



TEST_F(Preconditions, RotationsAreRotations)
{
  EXPECT_THROW(vector_of_rotation(2 * Matrix3::Identity()), dealii::ExceptionBase);
  EXPECT_THROW(inverse_cayley(rotation_of_angles(Vector3(M_PI, 0, 0), "321")), dealii::ExceptionBase);
  EXPECT_THROW(ElementTable<1>(0), dealii::ExceptionBase);
}

#endif
