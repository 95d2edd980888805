#ifndef samara_input_assembled_drawing_h
#define samara_input_assembled_drawing_h

#include <samara/solvers/assembly.h>

#include <map>

namespace samara
{
  /** What the entries of subsection "Assembly" say. */
  struct AssemblySettings
  {
    std::string              gaps = "refused"; ///< of joints that say nothing themselves
    std::vector<std::string> fixed, weights;   ///< "crank"; "rod: 10"

    void add_parameters(Parameters &prm);
  };



  /** How the bodies of a drawing have been moved until its joints fit, see Assembly. */
  struct AssembledDrawing
  {
    /**
     * Assemble a model whose joints were made with Gaps::open. What is wrong in the settings, and a gap that stays, is
     * said with the places of @p entries. @throws InputError
     */
    AssembledDrawing(System &drawn, const AssemblySettings &settings, const Parameters &entries);

    struct MovedBody
    {
      std::string name;
      Placement   motion;       ///< the identity of what has not moved
      double      distance = 0; ///< of that of its points that has moved furthest [m]
      double      angle    = 0; ///< [rad]
    };
    std::vector<MovedBody>     bodies;
    std::vector<Assembly::Gap> joints; ///< with the gaps of the drawing

    double       drawn_gap = 0, gap = 0, distance = 0; ///< [m]
    unsigned int start = 0;                            ///< see Assembly

    /** Whether anything has moved. */
    bool has_moved() const;

    /** How the body of a path, "rod.end" or "ground", has moved, named from a subsystem, see Model::scope. */
    Placement motion_of(const std::string &path, const std::string &scope) const;

    /** A table for people. */
    std::string text() const;

    /** The same for programs: body, displacement, angle, motion. */
    void write(const std::string &file) const;

  private:
    void check_and_read(const System           &drawn,
                        const AssemblySettings &settings,
                        const Parameters       &entries,
                        std::vector<double>    &weights,
                        std::vector<bool>      &fixed) const;
  };
} // namespace samara

#endif
