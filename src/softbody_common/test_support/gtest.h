#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace softbody {

/// What a call says that throws an `Error`; empty if it does not throw.
template <typename Error = std::invalid_argument, typename Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Whether a text contains the words.
inline ::testing::AssertionResult says(const std::string& text, const std::string& words) {
  if (text.find(words) != std::string::npos) return ::testing::AssertionSuccess() << "'" << text << "'";
  return ::testing::AssertionFailure() << "'" << text << "' does not say '" << words << "'";
}

}  // namespace softbody
