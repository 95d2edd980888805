// Time of a cross-section analysis against its unknowns, prismatic and twisted: doc/theory/cross_section.md.

#include <samara/section/cross_section.h>
#include <samara/section/elasticity.h>
#include <samara/section/patches.h>

#include <cstdio>

#include "cpu_seconds.h"

using namespace samara;

int
main()
{
  std::printf("%-8s %6s %8s %10s %12s %12s\n", "shape", "degree", "twist", "unknowns", "mesh [s]", "analysis [s]");
  for (const unsigned int degree : {2u, 3u, 4u})
    for (const bool is_ring : {true, false})
      for (const double twist : {0., 0.1})
        {
          // about 1e5 unknowns
          const unsigned int n       = 180 / degree;
          const auto         patches = is_ring ? ring_patches(0.95, 1, 30 * 60 / degree, 18 / degree) :
                                                 rectangle_patches(1, 1, n, n);
          const double       start   = cpu_seconds();
          const SectionMesh  mesh(patches, degree, 1e-7);
          const double       meshed = cpu_seconds();
          const CrossSection section(mesh, {{elasticity::isotropic_stiffness(1, 0.3), 1.}}, {twist, 0, 0});
          std::printf("%-8s %6u %8g %10u %12.3f %12.3f\n",
                      is_ring ? "ring" : "block",
                      degree,
                      twist,
                      section.n_unknowns(),
                      meshed - start,
                      cpu_seconds() - meshed);
        }
}
