#ifndef samara_model_moved_h
#define samara_model_moved_h

#include <samara/base/placement.h>
#include <samara/model/frame.h>

#include <functional>
#include <string>
#include <vector>

namespace samara
{
  /** How the body of a path, "rod.end" or "ground", has moved from where it is drawn. */
  using MotionOf = std::function<Placement(const std::string &path)>;

  /**
   * What becomes of joints whose two points are drawn apart: they complain; they hold the points as drawn, so that
   * their rows tell the gap, for who looks how to move the bodies; or that has been done, and the points meet.
   */
  enum class Gaps
  {
    refused,
    open,
    closed
  };



  /** What goes along with bodies when a rough drawing is assembled, see Assembly. Bodies themselves are placed. */
  class MovesWithBodies
  {
  public:
    virtual ~MovesWithBodies() = default;

    /**
     * Take what is said of the drawing to where the bodies have been moved: what is fixed to a body goes with it, what
     * has inertial axes stays. Before initialize().
     */
    virtual void be_moved(const MotionOf &motion_of) = 0;
  };



  /** What connects two bodies, for those who look at the graph of them. */
  class Connection : public MovesWithBodies
  {
  public:
    /** The frames that it connects, on nodes of the closed model: A and B, or none. After connect(). */
    virtual std::vector<Frame> connected_frames() const = 0;

    /** Before initialize(). */
    Gaps gaps = Gaps::refused;

    /** Whether `gaps` is for all that do not allow their gap, or for those alone that say they close it. */
    bool closes_all_gaps = false;
  };
} // namespace samara

#endif
