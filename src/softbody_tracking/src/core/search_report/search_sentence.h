#pragma once

#include <string>

#include "search_report/search_report.h"

namespace softbody {

/// Why the body was not found, with numbers, and what to do. Empty if it was found.
std::string whyNotFound(const SearchReport& report);

}  // namespace softbody
