// Pictures of sections for ParaView.

#include <samara/recovery/section_report.h>
#include <samara/section/recovery.h>

#include <deal.II/base/data_out_base.h>

namespace samara
{
  namespace
  {
    using Patch = dealii::DataOutBase::Patch<2, 3>;

    /** Fields at the points of a picture: numbers, or three numbers that are a vector. */
    class Fields
    {
    public:
      void
      add(const std::string &name)
      {
        names.push_back(name);
      }

      void
      add_vector(const std::string &name)
      {
        vectors.emplace_back(names.size(),
                             names.size() + 2,
                             name,
                             dealii::DataComponentInterpretation::component_is_part_of_vector);
        names.insert(names.end(), 3, name);
      }

      std::vector<std::string> names;
      std::vector<std::tuple<unsigned int,
                             unsigned int,
                             std::string,
                             dealii::DataComponentInterpretation::DataComponentInterpretation>>
        vectors;
    };

    /** Values of the fields at a point, and its place. */
    using ValuesAt = std::function<Vector3(const CrossSection::StressPoint &point, std::vector<double> &values)>;



    /** Fields with their values, at all points. */
    struct Picture
    {
      Fields   fields;
      ValuesAt values_at;
    };



    /** Points of each cell by rows: p + 1 times p + 1 of cells of degree p, at equal distances. */
    std::vector<CrossSection::StressPoint>
    points_of(const SectionAnalysis &analysis)
    {
      const unsigned int            p = analysis.mesh.degree, n = (p + 1) * (p + 1);
      std::vector<dealii::Point<2>> units;
      for (unsigned int j = 0; j <= p; ++j)
        for (unsigned int i = 0; i <= p; ++i)
          units.emplace_back(double(i) / p, double(j) / p);
      return analysis.section.extrapolated(dealii::Quadrature<2>(units, std::vector<double>(n, 1. / n)));
    }



    std::string
    vtu(const SectionAnalysis &analysis, const Picture &picture)
    {
      const unsigned int  p = analysis.mesh.degree, n = (p + 1) * (p + 1), n_fields = picture.fields.names.size();
      const auto          points = points_of(analysis);
      std::vector<Patch>  patches(points.size() / n);
      std::vector<double> values;
      for (unsigned int c = 0; c < patches.size(); ++c)
        {
          Patch &patch               = patches[c];
          patch.patch_index          = c;
          patch.n_subdivisions       = p;
          patch.points_are_available = true;
          patch.reference_cell       = dealii::ReferenceCells::Quadrilateral;
          patch.data.reinit(n_fields + 3, n);
          for (unsigned int k = 0; k < n; ++k)
            {
              values.clear();
              const Vector3 x = picture.values_at(points[c * n + k], values);
              for (unsigned int i = 0; i < n_fields; ++i)
                patch.data(i, k) = values.at(i);
              for (unsigned int d = 0; d < 3; ++d)
                patch.data(n_fields + d, k) = x(d);
              if (k == 0 || k == p || k == n - p - 1 || k == n - 1)
                patch.vertices[k == 0 ? 0 : k == p ? 1 : k == n - 1 ? 3 : 2] = dealii::Point<3>(x(0), x(1), x(2));
            }
        }
      dealii::DataOutBase::VtkFlags flags;
      flags.print_date_and_time = false;
      std::ostringstream text;
      dealii::DataOutBase::write_vtu(patches, picture.fields.names, picture.fields.vectors, flags, text);
      return text.str();
    }



    /** The same flat, axes 2 and 3 as y and z, for the page of a report. */
    Drawing
    drawing(const SectionAnalysis &analysis, const Picture &picture, const std::string &name)
    {
      const unsigned int  p = analysis.mesh.degree, n = (p + 1) * (p + 1);
      const auto          points = points_of(analysis);
      std::vector<double> values;
      Drawing             result;
      result.begin_object(name);
      for (unsigned int c = 0; c < points.size() / n; ++c)
        {
          std::vector<Sample> samples(n);
          for (unsigned int k = 0; k < n; ++k)
            samples[k].x = {0., points[c * n + k].place[0], points[c * n + k].place[1]};
          const unsigned int first = result.grid(p + 1, p + 1, samples).first_sample;
          for (unsigned int k = 0; k < n; ++k)
            {
              values.clear();
              picture.values_at(points[c * n + k], values);
              const auto &names = picture.fields.names;
              for (unsigned int i = 0; i < names.size();)
                {
                  // three numbers of one name are a vector
                  const bool        is_vector = i + 2 < names.size() && names[i + 1] == names[i];
                  const std::string unit =
                    names[i].find("stress") != std::string::npos && names[i].find("index") != 0 ? "Pa" : "";
                  Field &field = result.field(names[i], unit, is_vector ? section_axes : std::vector<std::string>());
                  if (is_vector)
                    field.set(first + k, Vector3(values[i], values[i + 1], values[i + 2]));
                  else
                    field.set(first + k, values[i]);
                  i += is_vector ? 3 : 1;
                }
            }
        }
      return result;
    }



    void
    append(const Vector3 &vector, std::vector<double> &values)
    {
      values.insert(values.end(), vector.data(), vector.data() + 3);
    }
    Picture
    of_section(const SectionAnalysis &analysis)
    {
      Fields fields;
      fields.add("material");
      fields.add_vector("fibre");
      fields.add_vector("normal_of_layer");
      for (const char *const force : {"F1", "F2", "F3", "M1", "M2", "M3"})
        fields.add_vector(std::string("warping_of_") + force);
      return {fields, [&analysis](const CrossSection::StressPoint &point, std::vector<double> &values) {
                values.push_back(analysis.mesh.ply(point.cell).material);
                append(point.axes.col(0), values);
                append(point.axes.col(2), values);
                for (int i = 0; i < 6; ++i)
                  append(point.warping.col(i), values);
                return Vector3(0, point.place[0], point.place[1]);
              }};
    }



    /** Stresses at the place @p x with section axes @p D. */
    Picture
    of_stresses(const SectionAnalysis &analysis,
                const Vector6         &forces,
                const double           helix,
                const Vector3         &x,
                const Matrix3         &D)
    {
      Fields fields;
      fields.add("material");
      fields.add_vector("place_in_section");
      for (const char *const axes : {"", "_in_material"})
        for (const char *const ij : {"11", "22", "33", "23", "13", "12"})
          fields.add(std::string("stress_") + ij + axes);
      for (const char *const name :
           {"von_Mises_stress", "index_max_stress", "index_Tsai_Wu", "index_Hashin", "index_von_Mises"})
        fields.add(name);
      return {fields,
              [&analysis, forces, helix, x, D](const CrossSection::StressPoint &point, std::vector<double> &values) {
                const unsigned int material = analysis.mesh.ply(point.cell).material;
                const Vector6      stress   = CrossSection::stress(point, forces, helix),
                              own           = CrossSection::stress_in_material(point, forces, helix);
                values.push_back(material);
                append(Vector3(0, point.place[0], point.place[1]), values);
                for (int i = 0; i < 6; ++i)
                  values.push_back(stress(i));
                for (int i = 0; i < 6; ++i)
                  values.push_back(own(i));
                values.push_back(von_mises_stress(own));
                const FailureIndices indices = failure_indices(analysis.shape.materials.at(material).strengths, own);
                for (const double index : {indices.max_stress, indices.tsai_wu, indices.hashin, indices.von_mises})
                  values.push_back(index);
                return Vector3(x + D * Vector3(0, point.place[0], point.place[1]));
              }};
    }
  } // namespace



  std::string
  picture_of(const SectionAnalysis &analysis)
  {
    return vtu(analysis, of_section(analysis));
  }



  std::string
  picture_of_stresses(const SectionAnalysis &analysis,
                      const Vector6         &forces,
                      const double           helix,
                      const Vector3         &x,
                      const Matrix3         &D)
  {
    return vtu(analysis, of_stresses(analysis, forces, helix, x, D));
  }



  Drawing
  drawing_of(const SectionAnalysis &analysis, const std::string &name)
  {
    return drawing(analysis, of_section(analysis), name);
  }



  Drawing
  drawing_of_stresses(const SectionAnalysis &analysis,
                      const Vector6         &forces,
                      const double           helix,
                      const std::string     &name)
  {
    return drawing(analysis, of_stresses(analysis, forces, helix, Vector3::Zero(), Matrix3::Identity()), name);
  }
} // namespace samara
