#pragma once

namespace viscard {

// Where and which way a load acts: on the top, or as an acceleration of the base.
enum class LoadPlace { kTop, kBase };
enum class LoadDirection { kAxial, kLateral };

}  // namespace viscard
