#include <samara/cosserat/analysed_section.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>

namespace samara
{
  namespace
  {
    /** FNV-1a of 64 bits, twice with different starts: a key of 128 bits. */
    class ContentKey
    {
    public:
      template <typename Number>
      void
      add(const Number &number)
      {
        unsigned char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        for (const unsigned char byte : bytes)
          for (auto &part : parts)
            part = (part ^ byte) * 1099511628211ull;
      }

      std::string
      text() const
      {
        return std::to_string(parts[0]) + " " + std::to_string(parts[1]);
      }

    private:
      std::array<std::uint64_t, 2> parts = {{14695981039346656037ull, 88172645463325252ull}};
    };



    /** What the analysis depends on: places and plies of all cells, and the materials. */
    std::string
    content_of(const SectionShape &shape, const unsigned int degree)
    {
      ContentKey key;
      key.add(degree);
      key.add(shape.finest);
      for (const auto &patch : shape.patches)
        for (unsigned int i = 0; i + 1 < patch.u.size(); ++i)
          for (unsigned int j = 0; j + 1 < patch.v.size(); ++j)
            {
              const Ply ply = patch.ply(i, j);
              key.add(ply.material);
              key.add(ply.angle);
              // as many points as a cell's polynomial has
              for (unsigned int a = 0; a <= degree; ++a)
                for (unsigned int b = 0; b <= degree; ++b)
                  {
                    const auto place = patch.place(patch.u[i] + (patch.u[i + 1] - patch.u[i]) * a / degree,
                                                   patch.v[j] + (patch.v[j + 1] - patch.v[j]) * b / degree);
                    key.add(place[0]);
                    key.add(place[1]);
                    if (patch.tangent)
                      {
                        const Eigen::Vector2d t = patch.tangent(place);
                        key.add(t(0));
                        key.add(t(1));
                      }
                  }
            }
      for (const auto &material : shape.materials)
        {
          for (int i = 0; i < 36; ++i)
            key.add(material.stiffness.data()[i]);
          key.add(material.density);
        }
      return key.text();
    }



    struct Known
    {
      std::mutex                                                             mutex;
      std::map<std::pair<std::string, std::array<double, 3>>, SectionValues> values;
    };

    Known &
    known_sections()
    {
      static Known known;
      return known;
    }



    /** Points of different patches that are nearer than this are one. */
    double
    tolerance_of(const SectionShape &shape)
    {
      return 1e-6 * shape.finest;
    }
  } // namespace



  SectionAnalysis::SectionAnalysis(const SectionShape &shape, const unsigned int degree, const Vector3 &curvature)
    : shape(shape)
    , mesh(shape.patches, degree, tolerance_of(shape))
    , section(mesh, shape.materials, curvature)
  {}



  void
  AnalysedSection::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Degree",
            degree,
            "Of the elements of the analysis: polynomial degree of the warping, 1 to 6.",
            Integer(1, 6));
    prm.add("Elements", elements, "Of the analysis, along the longest side; others in proportion.", Integer(1, 200));
    prm.add("Elements per ply", per_ply, "Of the analysis, through the thickness of each ply.", Integer(1, 20));
    prm.add("Position",
            position,
            "Of the shape's own origin, coordinates 2 and 3 from the reference line of the beam [m].",
            List(Double(), 2, 2));
    prm.add("Rotation", rotation, "Of the shape about axis 1 [rad].");
    prm.add(
      "Initial curvature",
      curvature_of,
      "What twist and curvature of the reference line the analysis takes into account: those of the beam, or none.",
      Selection("beam|none"));
    prm.add("Trapeze effect",
            has_trapeze,
            "Whether tension stiffens torsion, as fibres away from the shear centre are longer in a twisted beam.");
  }



  void
  AnalysedSection::initialize(Model &model)
  {
    const auto before = model.complaints.count();
    if (is_analysed())
      try
        {
          shape = make_shape(model);
          if (model.complaints.count() != before)
            return;
          place_shape();
          content = content_of(shape, degree) + (has_trapeze ? " trapeze" : "");
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where(), problem.what());
          return;
        }
    if (model.complaints.count() == before)
      check(model);
  }



  void
  AnalysedSection::check(Model &model) const
  {
    try
      {
        Section::check(model);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(), "section <" + name + ">: " + problem.what());
      }
  }



  void
  AnalysedSection::place_shape()
  {
    const double           c = std::cos(rotation), s = std::sin(rotation);
    const dealii::Point<2> origin(position[0], position[1]);
    const auto             moved = [=](const dealii::Point<2> &x) {
      return dealii::Point<2>(origin[0] + c * x[0] - s * x[1], origin[1] + s * x[0] + c * x[1]);
    };
    for (auto &patch : shape.patches)
      {
        const auto own = patch.place;
        patch.place    = [own, moved](const double u, const double v) { return moved(own(u, v)); };
        if (const auto tangent = patch.tangent)
          patch.tangent = [=](const dealii::Point<2> &x) {
            const double          y2 = x[0] - origin[0], y3 = x[1] - origin[1];
            const Eigen::Vector2d t = tangent(dealii::Point<2>(c * y2 + s * y3, c * y3 - s * y2));
            return Eigen::Vector2d(c * t(0) - s * t(1), s * t(0) + c * t(1));
          };
      }
    for (auto &corner : shape.outline)
      {
        const auto x = moved({corner(0), corner(1)});
        corner << x[0], x[1];
        size = std::max(size, corner.norm());
      }
  }



  Vector3
  AnalysedSection::rounded(const Vector3 &curvature) const
  {
    // what differs by round-off is one, and what turns by less than 1e-9 in a depth is straight
    const double unit = 1e-9 / size;
    return ((curvature / unit).array().round() * unit).matrix() + Vector3::Zero(); // no −0
  }



  bool
  AnalysedSection::depends_on_curvature() const
  {
    return is_analysed() && curvature_of == "beam";
  }



  std::vector<Eigen::Vector2d>
  AnalysedSection::outline(double) const
  {
    return shape.outline;
  }



  SectionValues
  AnalysedSection::at(double, const Vector3 &curvature) const
  {
    const Vector3 k     = depends_on_curvature() ? rounded(curvature) : Vector3(Vector3::Zero());
    Known        &known = known_sections();
    {
      const std::lock_guard<std::mutex> guard(known.mutex);
      if (std::find(asked.begin(), asked.end(), k) == asked.end())
        asked.push_back(k);
      const auto found = known.values.find({content, {{k(0), k(1), k(2)}}});
      if (found != known.values.end())
        {
          SectionValues values = found->second;
          values.outline       = shape.outline;
          return values;
        }
    }
    const auto    analysis = analyse(k);
    SectionValues values{analysis->section.stiffness, analysis->section.inertia, shape.outline};
    if (has_trapeze)
      values.trapeze = trapeze_of(analysis->section);
    const std::lock_guard<std::mutex> guard(known.mutex);
    known.values[{content, {{k(0), k(1), k(2)}}}] = values;
    return values;
  }



  std::unique_ptr<SectionAnalysis>
  AnalysedSection::analyse(const Vector3 &curvature, const unsigned int more_degrees) const
  {
    return std::make_unique<SectionAnalysis>(shape, degree + more_degrees, curvature);
  }



  std::vector<Vector3>
  AnalysedSection::curvatures() const
  {
    return asked.empty() ? std::vector<Vector3>(1, Vector3::Zero()) : asked;
  }



  Fineness
  AnalysedSection::fineness() const
  {
    return {elements, per_ply};
  }



  void
  AnalysedSection::try_mesh(const SectionShape &shape) const
  {
    SectionMesh(shape.patches, degree, tolerance_of(shape));
  }



  double
  AnalysedSection::finest_of(const std::vector<Wall> &walls, const double longest) const
  {
    double result = longest / elements;
    for (const Wall &wall : walls)
      for (const WallPly &ply : wall)
        result = std::min(result, ply.thickness / per_ply);
    return result;
  }



  unsigned int
  AnalysedSection::material_number(Model             &model,
                                   SectionShape      &shape,
                                   const std::string &entry,
                                   const std::string &name) const
  {
    try
      {
        const SectionMaterial &wanted = model.find<Material>(name, "material").properties();
        for (unsigned int i = 0; i < shape.materials.size(); ++i)
          if (shape.materials[i].name == name)
            return i;
        shape.materials.push_back(wanted);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(entry), problem.what());
        return 0;
      }
    return shape.materials.size() - 1;
  }



  bool
  AnalysedSection::is_positive(Model &model, const std::string &entry, const double value) const
  {
    if (value > 0)
      return true;
    model.complaints.add(parameters.where(entry),
                         "section <" + name + "> needs <" + entry + ">, above zero" +
                           (parameters.is_set(entry) ? "" : "; it is not given"));
    return false;
  }



  Wall
  AnalysedSection::wall(Model             &model,
                        SectionShape      &shape,
                        const std::string &layup_entry,
                        const std::string &layup,
                        const std::string &material,
                        const std::string &thickness_entry,
                        const double       thickness) const
  {
    Wall result;
    if (layup.empty())
      {
        if (material.empty())
          model.complaints.add(parameters.where("Material"),
                               "section <" + name + "> needs a <" + layup_entry + ">, or a <Material> and <" +
                                 thickness_entry + ">");
        else if (is_positive(model, thickness_entry, thickness))
          result.push_back({material_number(model, shape, "Material", material), 0, thickness});
        return result;
      }
    if (parameters.is_set(thickness_entry) && material.empty())
      model.complaints.add(parameters.where(thickness_entry),
                           "<" + thickness_entry + "> and <" + layup_entry +
                             "> are both given: a layup has its thickness");
    try
      {
        for (const Layup::Ply &ply : model.find<Layup>(layup, "layup").plies())
          result.push_back({material_number(model, shape, layup_entry, ply.material->name), ply.angle, ply.thickness});
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(layup_entry), problem.what());
      }
    return result;
  }
} // namespace samara
