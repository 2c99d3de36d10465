// Copyright 2025 The roslens authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

#include <gtest/gtest.h>

#include "rover_navigation/path.hpp"

using rover_navigation::Path;
using rover_navigation::Point;

TEST(Path, MeasuresItself)
{
  const Path path({{0, 0}, {3, 0}, {3, 4}});
  EXPECT_DOUBLE_EQ(path.length(), 7.0);
  EXPECT_DOUBLE_EQ(path.along({1.0, 0.5}), 1.0);
  EXPECT_DOUBLE_EQ(path.along({4.0, 2.0}), 5.0);
}

TEST(Path, StopsAtItsEnds)
{
  const Path path({{0, 0}, {3, 0}});
  EXPECT_DOUBLE_EQ(path.at(-1.0).x, 0.0);
  EXPECT_DOUBLE_EQ(path.at(1.5).x, 1.5);
  EXPECT_DOUBLE_EQ(path.at(9.0).x, 3.0);
}

TEST(Path, StandsAPieceWithoutLength)
{
  const Path path({{1, 1}, {1, 1}});
  EXPECT_DOUBLE_EQ(path.along({5.0, 5.0}), 0.0);
  EXPECT_DOUBLE_EQ(path.at(1.0).x, 1.0);
}
