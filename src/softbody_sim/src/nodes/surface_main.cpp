#include "nodes/run_node.h"
#include "nodes/surface_node.h"

int main(int argc, char** argv) { return softbody::runNode<softbody::SurfaceNode>(argc, argv, "surface"); }
