//! `impact-pair audit SCENE EVENTS`: another simulator's list of impacts, compared with the certified orbit.

pub const EXIT_CODES: &str = "\
Exit code: 0 all agree; 1 something disagrees or is undecided; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair audit scenes/figure-14.toml events.csv
  impact-pair audit scenes/figure-14.toml sol.txt --wall-column 3 --no-velocity --tolerance 1e-6
  impact-pair run scenes/figure-14.toml --arithmetic float --format json |
    impact-pair audit scenes/figure-14.toml - --format json --output audit.json

The list: text with commas, semicolons, tabs or blanks between columns, with a header, with a header in a comment (# \
or %) that has a word for each column, or without one: then time, wall and velocity are columns 1, 2 and 3. Or JSON: an array of objects, an object \
of arrays, JSON Lines, or the orbit JSON. Walls are left and right, L and R, -1 and +1, or positions near -d/2 and \
+d/2. Velocities are y' just before the impact, with their sign. Numbers are read exactly. Columns that are not read \
are named in the last line and in the JSON (unused_columns). The certified orbit goes as far as the list; [run] \
is not used.

Verdicts on a row, or on a certified impact without a row:
  inside          certified; time and velocity are within the tolerance of the bounds
  outside         certified; time or velocity is proved to be farther away than that
  missed          certified before the end of the list, but not listed
  false           proved not to happen
  in the chatter  on its wall, no faster, and after the last impact of a chatter that is farther
                  than the tolerance from its end: infinitely many impacts lie there, and none of
                  them has to be listed
  undecided       after the last impact that could be certified
  not reached     later than that; the list lacks more impacts than it has rows, and the orbit is
                  not followed further
The start and grazes may be listed or not; of a graze, wall and time are compared.

A row may be an impact if it lies on the same wall, and is nearest to it among all impacts or within the tolerance. \
The start or a graze takes no row that is nearer to an impact. \
As many rows as possible are matched, in the order of the list; of several rows for one impact the nearest in time \
is taken. The list diverges from the orbit at the first missed or false impact from which on, counted to any later \
one, fewer than half are inside, if both kinds occur after it.

Double precision is compared in the same way. Exact from rounded data: the certified orbit of the scene with each \
number rounded to the nearest double; once it is outside, any simulator that reads the scene in doubles is right \
only by chance, however accurate. --arithmetic float: impact-pair's own orbit in plain doubles; it has no \
consequence for other programs.

Exit code: 0 all agree (all rows are inside or in the chatter, none is missed); 1 something disagrees or is \
undecided; 2 usage, bad input, I/O.";
