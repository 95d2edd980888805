#include <samara/cosserat/analysed_section.h>
#include <samara/cosserat/section_loft.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <typeinfo>

namespace samara
{
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
          SectionShape shape = make_shape(model);
          if (model.complaints.count() != before)
            return;
          place(shape);
          placed = std::make_shared<AnalysedShape>(shape, degree, has_trapeze, curvature_of == "beam");
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
  AnalysedSection::place(SectionShape &shape) const
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
      }
  }



  bool
  AnalysedSection::depends_on_curvature() const
  {
    return is_analysed() && curvature_of == "beam";
  }



  std::vector<Eigen::Vector2d>
  AnalysedSection::outline(double) const
  {
    return placed->shape.outline;
  }



  SectionValues
  AnalysedSection::at(double, const Vector3 &curvature) const
  {
    {
      static std::mutex                 one_at_a_time;
      const std::lock_guard<std::mutex> guard(one_at_a_time);
      const Vector3                     k = placed->seen(curvature);
      if (std::find(asked.begin(), asked.end(), k) == asked.end())
        asked.push_back(k);
    }
    return placed->values(curvature);
  }



  std::unique_ptr<SectionAnalysis>
  AnalysedSection::analyse(const Vector3 &curvature, const unsigned int more_degrees) const
  {
    return placed->analyse(curvature, more_degrees);
  }



  std::vector<StressedSection>
  AnalysedSection::stressed(double, double) const
  {
    return is_analysed() && placed != nullptr ? std::vector<StressedSection>{{name, placed}} :
                                                std::vector<StressedSection>();
  }



  std::unique_ptr<const SectionLoft>
  AnalysedSection::loft_to(const Section &other) const
  {
    const auto *const that = other.analysed();
    if (that == nullptr || placed == nullptr || that->placed == nullptr || typeid(*this) != typeid(*that))
      return nullptr;
    return AnalysedLoft::make(placed, that->placed);
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



  unsigned int
  AnalysedSection::try_mesh(const SectionShape &shape) const
  {
    return mesh_of(shape, degree)->n_touching;
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
