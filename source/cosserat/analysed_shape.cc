#include <samara/cosserat/analysed_shape.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
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
        for (const unsigned int corner : patch.corners)
          key.add(corner);
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



  std::unique_ptr<SectionMesh>
  mesh_of(const SectionShape &shape, const unsigned int degree)
  {
    return std::make_unique<SectionMesh>(shape.patches, degree, tolerance_of(shape));
  }



  SectionAnalysis::SectionAnalysis(const SectionShape &shape, const unsigned int degree, const Vector3 &curvature)
    : shape(shape)
    , own_mesh(mesh_of(shape, degree))
    , mesh(*own_mesh)
    , section(mesh, shape.materials, curvature)
  {}



  AnalysedShape::AnalysedShape(const SectionShape &shape,
                               const unsigned int  degree,
                               const bool          has_trapeze,
                               const bool          sees_curvature)
    : shape(shape)
    , degree(degree)
    , has_trapeze(has_trapeze)
    , sees_curvature(sees_curvature)
    , content(content_of(shape, degree) + (has_trapeze ? " trapeze" : ""))
  {
    for (const auto &corner : shape.outline)
      size = std::max(size, corner.norm());
  }



  Vector3
  AnalysedShape::seen(const Vector3 &curvature) const
  {
    if (!sees_curvature)
      return Vector3::Zero();
    // what differs by round-off is one, and what turns by less than 1e-9 in a depth is straight
    const double unit = 1e-9 / size;
    return ((curvature / unit).array().round() * unit).matrix() + Vector3::Zero(); // no −0
  }



  SectionValues
  AnalysedShape::values(const Vector3 &curvature) const
  {
    const Vector3 k     = seen(curvature);
    Known        &known = known_sections();
    {
      const std::lock_guard<std::mutex> guard(known.mutex);
      const auto                        found = known.values.find({content, {{k(0), k(1), k(2)}}});
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
  AnalysedShape::analyse(const Vector3 &curvature, const unsigned int more_degrees) const
  {
    return std::make_unique<SectionAnalysis>(shape, degree + more_degrees, seen(curvature));
  }
} // namespace samara
