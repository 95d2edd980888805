#ifndef samara_input_mechanism_graph_h
#define samara_input_mechanism_graph_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * Bodies and what connects them, as a graph: the nodes of a body, and of bodies that are welded, are one vertex; the
   * ground is vertex 0. Gears and what else acts on relative motions are not in it.
   */
  class MechanismGraph
  {
  public:
    /** In the reference configuration of the system. */
    explicit MechanismGraph(const System &system);

    struct Vertex
    {
      std::string name; ///< of its bodies: "hub, blade 1"; "ground"
    };
    struct Edge
    {
      std::string  name, kind;
      unsigned int a = 0, b = 0;
      Vector3      at_a, at_b;        ///< of its two frames [m]
      bool         constrains = true; ///< or it is a spring
    };
    std::vector<Vertex> vertices;
    std::vector<Edge>   edges;

    /**
     * As many loops of constraints as are independent, the shortest through each joint that closes one: numbers of
     * edges, in the order of the loop, which begins at the vertex that is nearest to the ground.
     */
    struct Loop
    {
      unsigned int              start = 0; ///< vertex
      std::vector<unsigned int> edges;
    };
    std::vector<Loop> loops;

    /** "ground - A - crank - B - coupler - C - rocker - D - ground" */
    std::string text(const Loop &loop) const;

    /** How many loops there are, and a line for each of the first ones. */
    std::string text() const;

    /** For Graphviz: bodies are boxes, joints lines between them, those of springs dashed. */
    std::string dot() const;

    /**
     * A drawing: bodies as lines between their joints, where these are, seen along the direction in which the mechanism
     * is thinnest; loops in colours.
     */
    std::string svg() const;

  private:
    void find_loops();
  };
} // namespace samara

#endif
