#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace softbody::fuzz {

struct FuzzReport {
  std::size_t messages = 0;  ///< mutated ones that reached the node
  double seconds = 0.0;
  double slowest_s = 0.0;  ///< of one message
  double grown_mb = 0.0;   ///< memory of the process, since a tenth of the run
  std::string fault;       ///< empty: none
};

/// Gives a number of mutated messages to a node of targetKinds(), and after some of them looks whether it
/// still does its work. A crash or a hang ends the process, with the seed and the number of the message.
/// @throw std::out_of_range if there is no such node.
FuzzReport fuzzNode(const std::string& node, std::uint64_t seed, std::size_t messages);

}  // namespace softbody::fuzz
