# Makes the comment at the top of a header the description of its file for Doxygen. The line of
# "#pragma once" gives way to one more line, so that the numbers of the lines stay.
1,/^#pragma once/{
  /^#pragma once/d
  s,^//,///,
  s,<,\&lt;,g
  1s,^,/// @file\
,
}
