#ifndef samara_section_airfoil_mesh_h
#define samara_section_airfoil_mesh_h

#include <samara/section/airfoil_outline.h>
#include <samara/section/shapes.h>

#include <array>
#include <functional>
#include <memory>
#include <stdexcept>

namespace samara
{
  /** What an airfoil is made of. Positions are fractions of the chord. */
  struct AirfoilDesign
  {
    /** A part of the skin that is different. */
    struct Range
    {
      bool   on_lower, on_upper;
      double from, to;
      Wall   wall;
      bool   is_added; ///< on the inside of the skin; otherwise in its place
    };
    struct Web
    {
      double lower, upper; ///< x/c of its middle at the inner faces of the skins
      Wall   wall;         ///< the first ply on the side of the trailing edge
    };

    Wall               skin; ///< first ply outside
    std::vector<Range> ranges;
    std::vector<Web>   webs;

    unsigned int trailing_material = 0;     ///< of the block behind the skins
    double       trailing_from     = -1;    ///< where it begins; below zero: where the skins come near each other
    bool         skins_run_on      = false; ///< into that block, ever thinner, with its material between them
    unsigned int nose_material     = 0;     ///< of a weight that fills the nose
    double       nose_to           = 0;     ///< as far as here; zero: there is none

    Fineness fineness; ///< along: of the chord
  };



  /** An airfoil that cannot be meshed: what and where, and a picture of it, SVG. */
  class AirfoilFault : public std::invalid_argument
  {
  public:
    AirfoilFault(const std::string &what, const std::string &picture)
      : std::invalid_argument(what)
      , picture(picture)
    {}

    std::string picture;
  };



  /**
   * Quadrilaterals of an airfoil. Skins are strips between breaks, where layups or webs begin and end; depth is along
   * the normals of the outline, and leans where a skin is thicker than the outline is round. All strips are cut at the
   * depths where any of them has the face of a ply, each as far as it is thick: strips share the cells of the plies
   * that go on, and those that end do so with a free face. Webs go straight from skin to skin. Where the skins come
   * near each other they end, and a block reaches to the trailing edge, blunt or sharp: of one material, or of the
   * skins, whose plies taper with the block, and one between them.
   *
   * A range that begins or ends above or below a web reaches to the face of the web that leaves the web under it.
   */
  class AirfoilMesh
  {
  public:
    /** @throws AirfoilFault if inner faces fold where a skin changes, or skins overlap, or webs have no place */
    AirfoilMesh(std::shared_ptr<const AirfoilOutline> outline, const AirfoilDesign &design);

    std::vector<SectionPatch>
           patches;           ///< skins from the trailing edge round the nose and back, webs, nose, trailing edge
    double finest        = 0; ///< smallest side of a cell [m]
    double trailing_from = 0; ///< x/c where the skins end

    /** The outline with the inner faces, and a circle where something is wrong. SVG. */
    std::string picture(const std::string &title, const dealii::Point<2> *fault = nullptr) const;

  private:
    using Place = dealii::Point<2>;

    /** A range on one side, in s. */
    struct Span
    {
      double      a, b;
      const Wall *wall;
      bool        is_added;
      /** Number of the face of a web where it begins or ends, or −1. */
      int at_a = -1, at_b = -1;
    };
    /** A strip between breaks. */
    struct Strip
    {
      double              a, b;
      Wall                wall;
      double              thickness;
      std::vector<double> s;      ///< ends of its cells
      std::vector<double> depths; ///< faces of its cells [m]
    };

    std::shared_ptr<const AirfoilOutline> outline;
    const AirfoilDesign                  &design;
    std::vector<Span>                     spans;
    std::vector<double>                   faces; ///< s of the webs: lower back, lower front, upper front, upper back
    double                                begin = 0, end = 0; ///< s where the skins begin and end
    std::array<double, 2>                 nose = {{0, 0}};    ///< s where a weight in the nose ends
    std::vector<Strip>                    strips;

    // layout (airfoil_layout.cc)
    Wall   wall_at(double s) const;
    double thickness_at(double s) const;
    Place  inner(double s) const;
    Place  at_depth(double s, double depth) const;
    void   find_spans();
    void   find_webs();
    void   find_web(unsigned int web);
    void   bind_spans(unsigned int web, bool upper, double low, double high);
    /** s on a side where the inner face, at the depth @p thickness, comes to where @p beyond is zero: below zero
     * towards the nose; near x/c = @p x. */
    double face_of(bool upper, double x, double thickness, const std::function<double(const Place &)> &beyond) const;
    /** Where it comes to x/c = @p x. */
    double face_of(bool upper, double x, double thickness) const;
    void   find_trailing_edge();
    void   find_nose();
    double gap(double x) const;
    void   find_strips();
    void   cut_strips();
    /** Into plies at the depths of all strips, into cells along it, and those over a web where the web's plies are. @{
     */
    void cut_through(Strip &strip, const std::vector<double> &depths, double same) const;
    void cut_along(Strip &strip) const;
    void cut_over_web(Strip &strip, const Wall &wall, bool upper) const;
    /** @} */
    /** Lets depth lean where a strip is thicker than the outline is round, and cuts strips there. @{ */
    void              add_folds();
    bool              add_fold_of(const Strip &strip, std::vector<Strip> &pieces);
    [[noreturn]] void fail_at_fold(const Strip &strip, double tightest) const;
    /** @} */
    void check_inner_faces() const;
    void check_webs(const std::vector<Place> &inner_face) const;

    // patches (airfoil_patches.cc)
    void             add_skins();
    void             add_web(unsigned int web);
    void             add_nose();
    void             add_trailing_edge();
    std::vector<Ply> trailing_plies(bool upper) const;
    void add_sharp_trailing_edge(const std::vector<Place> &upper_nodes, const std::vector<Place> &lower_nodes);
    void add_blunt_trailing_edge(const std::vector<Place> &upper_nodes, const std::vector<Place> &lower_nodes);
    void find_finest();

    const Strip &strip_at(double s) const;
    Place        inner_of_strip(double s) const;

    [[noreturn]] void fail(const std::string &what, const Place &where) const;
    std::string       at_x(double s) const;
  };
} // namespace samara

#endif
