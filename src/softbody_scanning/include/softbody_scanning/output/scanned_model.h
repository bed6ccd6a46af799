#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "softbody_scanning/scan/checked_scan.h"
#include "softbody_sim/report/model_folder.h"

namespace softbody::scanning {

/// A mesh's size and the middle of its bounding box, in words.
std::string sizeAndPlaceOf(const TriangleMesh& mesh);

/// What a user should know about a scan, in sentences.
std::string reportOf(const CheckedScan& scan);

/// Writes the object folder of prepareModel, and in it scan.ply with what was seen, and report/scan.txt. The
/// object's frame has its origin in the middle of the bounding box and the axes of the model frame. If
/// prepareModel fails, an earlier folder is unchanged.
/// @param text of report/scan.txt. @param progress gets the finished share, 0..1. @param output gets
/// prepareModel's report. @throw as prepareModel.
Verdict writeModel(CheckedScan scan, const std::string& text, const std::string& folder,
                   const std::function<void(double)>& progress, std::ostream& output);

}  // namespace softbody::scanning
