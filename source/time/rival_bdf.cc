#include <samara/time/rival_bdf.h>

#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

// What IDA calls, and how it is called. The equations are in rival_bdf_equations.cc.

namespace samara
{
  struct Bdf::Ida
  {
    SUNContext      context = nullptr;
    void           *memory  = nullptr;
    N_Vector        z = nullptr, z_dot = nullptr, tolerances = nullptr;
    SUNMatrix       matrix       = nullptr;
    SUNLinearSolver solver       = nullptr;
    bool            is_allocated = false;

    ~Ida()
    {
      if (memory != nullptr)
        IDAFree(&memory);
      if (solver != nullptr)
        SUNLinSolFree(solver);
      if (matrix != nullptr)
        SUNMatDestroy(matrix);
      for (const N_Vector v : {z, z_dot, tolerances})
        if (v != nullptr)
          N_VDestroy(v);
      if (context != nullptr)
        SUNContext_Free(&context);
    }

    static const double *
    values(const N_Vector v)
    {
      return N_VGetArrayPointer(v);
    }

    /** Call an equation; IDA is to try something else if that is impossible. */
    template <typename Function>
    static int
    guarded(const Function &function)
    {
      try
        {
          function();
          return 0;
        }
      catch (const std::exception &)
        {
          return 1;
        }
    }

    static int
    residual(const double time, const N_Vector z, const N_Vector z_dot, const N_Vector r, void *const user)
    {
      return guarded(
        [&] { static_cast<Bdf *>(user)->residual(time, values(z), values(z_dot), N_VGetArrayPointer(r)); });
    }

    static int
    jacobian(const double   time,
             const double   cj,
             const N_Vector z,
             const N_Vector z_dot,
             N_Vector,
             SUNMatrix,
             void *const user,
             N_Vector,
             N_Vector,
             N_Vector)
    {
      return guarded([&] { static_cast<Bdf *>(user)->make_jacobian(time, cj, values(z), values(z_dot)); });
    }

    static int
    solve(const SUNLinearSolver solver, SUNMatrix, const N_Vector x, const N_Vector b, double)
    {
      N_VScale(1., b, x);
      static_cast<const Bdf *>(solver->content)->solve(N_VGetArrayPointer(x));
      return 0;
    }

    // the matrix is kept by Bdf: IDA has an empty one
    static SUNMatrix
    make_matrix(const SUNContext context)
    {
      const SUNMatrix A = SUNMatNewEmpty(context);
      A->ops->getid     = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
      A->ops->zero      = [](SUNMatrix) { return 0; };
      A->ops->clone     = [](SUNMatrix other) { return make_matrix(other->sunctx); };
      A->ops->destroy   = [](SUNMatrix other) { SUNMatFreeEmpty(other); };
      return A;
    }

    static SUNLinearSolver
    make_solver(const SUNContext context, Bdf &owner)
    {
      const SUNLinearSolver s = SUNLinSolNewEmpty(context);
      s->content              = &owner;
      s->ops->gettype         = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
      s->ops->getid           = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
      s->ops->initialize      = [](SUNLinearSolver) { return 0; };
      s->ops->setup           = [](SUNLinearSolver, SUNMatrix) { return 0; };
      s->ops->solve           = solve;
      s->ops->free            = [](SUNLinearSolver other) {
        SUNLinSolFreeEmpty(other);
        return 0;
      };
      return s;
    }
  };



  Bdf::Bdf(const System &system, const Form form, const IntegratorSettings &settings)
    : system(system)
    , form(form)
    , settings(settings)
    , ida(std::make_unique<Ida>())
    , measure(system)
    , projection(system)
    , matrix(system.layout.pattern)
    , M(system.layout.pattern)
    , C(system.layout.pattern)
    , K(system.layout.pattern)
    , before(system.layout.pattern)
    , after(system.layout.pattern)
    , is_active(rivals::active_multipliers(system))
    , is_nonholonomic(rivals::nonholonomic_multipliers(system))
    , n_poses(7 * (system.layout.n_nodes - 1))
  {
    const Layout &layout  = system.layout;
    n_kinematic           = n_poses + layout.n_coordinates;
    of_velocities         = n_kinematic;
    of_multipliers        = of_velocities + layout.of_multiplier(0);
    of_second_multipliers = of_multipliers + layout.n_multipliers;
    size                  = of_second_multipliers + (form == Form::stabilised_index_2 ? layout.n_multipliers : 0);
    system.mass(M);
    work = system.reference();

    Ida       &i  = *ida;
    const bool ok = SUNContext_Create(nullptr, &i.context) == 0 && (i.z = N_VNew_Serial(size, i.context)) &&
                    (i.z_dot = N_VNew_Serial(size, i.context)) && (i.tolerances = N_VNew_Serial(size, i.context)) &&
                    (i.memory = IDACreate(i.context)) && (i.matrix = Ida::make_matrix(i.context)) &&
                    (i.solver = Ida::make_solver(i.context, *this));
    if (!ok)
      throw std::runtime_error("SUNDIALS: IDA cannot be set up");
  }



  Bdf::~Bdf() = default;



  void
  Bdf::forget_history()
  {
    is_running = false;
  }



  void
  Bdf::step_back()
  {
    is_running = false;
  }



  void
  Bdf::start(State &state, const double h)
  {
    projection.velocities(state);
    system.stresses(state, state.stress);
    const std::vector<double> accelerations = projection.accelerations(state);
    Ida                      &i             = *ida;
    pack(state, accelerations, N_VGetArrayPointer(i.z), N_VGetArrayPointer(i.z_dot));

    // absolute: a length, and velocities of the size they have, or that move by a thousandth of it in a step
    const double  scale = std::max(1e-3 / h, measure.largest(state.y, state.rates)), rtol = settings.tolerance;
    double *const tolerance = N_VGetArrayPointer(i.tolerances);
    std::fill(tolerance, tolerance + size, 1e20); // multipliers do not count
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      for (unsigned int k = 0; k < 7; ++k)
        {
          tolerance[7 * (node - 1) + k] = rtol * (k < 3 ? measure.length : 1.);
          if (k < 6)
            tolerance[of_velocities + 6 * (node - 1) + k] = rtol * scale * (k < 3 ? measure.length : 1.);
        }
    for (unsigned int k = 0; k < system.layout.n_coordinates; ++k)
      {
        const double unit      = system.layout.scale_of(system.layout.of_coordinate(k), measure.length);
        tolerance[n_poses + k] = rtol * unit;
        tolerance[of_velocities + 6 * (system.layout.n_nodes - 1) + k] = rtol * scale * unit;
      }

    if (i.is_allocated)
      {
        IDAReInit(i.memory, state.time, i.z, i.z_dot);
        IDASVtolerances(i.memory, rtol, i.tolerances);
      }
    else
      {
        IDAInit(i.memory, Ida::residual, state.time, i.z, i.z_dot);
        IDASetUserData(i.memory, this);
        IDASVtolerances(i.memory, rtol, i.tolerances);
        IDASetLinearSolver(i.memory, i.solver, i.matrix);
        IDASetJacFn(i.memory, Ida::jacobian);
        IDASetErrHandlerFn(
          i.memory, [](int, const char *, const char *, char *, void *) {}, nullptr);
        i.is_allocated = true;
      }
    is_running = true;
  }



  bool
  Bdf::integrate(const double end, State &now, rivals::Powers &work_done)
  {
    constexpr unsigned int max_steps = 100000;
    const Ida             &i         = *ida;
    rivals::Powers         power     = rivals::powers(system, now);
    double                 time      = now.time;
    for (unsigned int n = 0; n < max_steps; ++n)
      {
        double    reached = time;
        const int flag    = IDASolve(i.memory, end, &reached, i.z, i.z_dot, IDA_ONE_STEP);
        if (flag != IDA_SUCCESS && flag != IDA_TSTOP_RETURN)
          return false;
        unpack(std::min(reached, last_time), N_VGetArrayPointer(i.z), now);
        const rivals::Powers next = rivals::powers(system, now);
        const double         half = 0.5 * (reached - time);
        work_done.add(half, power);
        work_done.add(half, next);
        if (flag == IDA_TSTOP_RETURN)
          return true;
        power = next;
        time  = reached;
      }
    return false;
  }



  StepResult
  Bdf::step(State &state, const double h)
  {
    StepResult   result;
    const double tiny = 1e-6 * h, end = state.time + h;
    State        now = state;
    now.held         = false;
    if (rivals::is_corner(system, state.time, tiny))
      is_running = false;
    work.held   = false;
    work.factor = state.factor;
    last_time   = rivals::is_corner(system, end, tiny) ? end - tiny : end;

    Ida     &i          = *ida;
    long int iterations = 0, done = 0, steps = 0, steps_done = 0;
    if (!is_running)
      {
        try
          {
            start(now, h);
          }
        catch (const SingularMatrix &)
          {
            return result;
          }
      }
    else
      {
        IDAGetNumNonlinSolvIters(i.memory, &done);
        IDAGetNumSteps(i.memory, &steps_done);
      }
    IDASetStopTime(i.memory, end);
    rivals::Powers work_done;
    is_running = integrate(end, now, work_done);
    IDAGetNumNonlinSolvIters(i.memory, &iterations);
    IDAGetNumSteps(i.memory, &steps);
    result.iterations = iterations - done;
    n_iterations += result.iterations;
    n_internal_steps += steps - steps_done;
    if (!is_running)
      return result;
    now.time = end;
    system.stresses(now, now.stress);
    const double *const y_dot = N_VGetArrayPointer(i.z_dot) + of_velocities;
    now.accelerations.assign(6, 0.);
    now.accelerations.insert(now.accelerations.end(), y_dot, y_dot + system.layout.of_multiplier(0));
    rivals::account(system, state, now, work_done, result);
    result.converged = true;
    state            = now;
    ++n_steps;
    return result;
  }
} // namespace samara
