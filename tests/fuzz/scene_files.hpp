// The files that the scenes of the seeds name, in the folder of the scenes.
#pragma once

#include "target.hpp"

namespace fuzz {

inline const Folder& scene_files() {
  static const Folder folder;
  folder.write("tetrahedron.stl",
               "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 "
               "0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 "
               "1\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 "
               "0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 "
               "1\nendloop\nendfacet\nendsolid a\n");
  folder.write("image.raw", std::string(8, '\1'));
  folder.write("points.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,1,1\n");
  folder.write("springs.csv", "a,b\n0,1\n0,2\n0,3\n1,4\n2,4\n3,4\n");
  folder.write("discs.csv", "x,y,z,nx,ny,nz,radius\n0,0,0,0,0,1,1\n");
  return folder;
}

}  // namespace fuzz
