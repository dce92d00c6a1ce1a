// Planted for the test of the include check; never compiled.
#pragma once

#include "tunica/stages/post/post.hpp"
