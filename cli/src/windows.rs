//! `impact-pair windows SCENE --over KEY=LO..HI`: stable periodic orbits near a scene and the windows in which they are stable, proved.

pub const HELP: &str = "\
Examples:
  impact-pair windows scenes/figure-14.toml --over gap=9.4247..9.4253 --impacts 4000000
  impact-pair windows scenes/figure-14.toml --over restitution=0.4999..0.5001 --impacts 2000000

Floating-point orbits of the reduced map, which mirrors every impact to the left wall, are searched for stable \
periodic orbits: half of them at the scene's own value of the parameter, the others at values of the range. Each \
orbit listed is proved at an exact value of the parameter: it exists, it is the only one within its bounds, and it is \
stable. Its window extends from a fold to a period doubling or a pitchfork, and both ends are enclosed. Where `stable \
between` is proved, there is a stable, admissible orbit of the word for every value between the bounds of the ends, \
and one curve of them leads from end to end through the orbit listed. \
Other windows are not excluded; floating-point orbits that are not proved, most of them long, have no claim. \
Windows of the doubled orbits, which adjoin, are not listed. One harmonic only.

The nearest windows to the scene's own value come first. Of windows narrower than about 10^-15 of the value, which \
doubles do not resolve, few are found.

Exit code: 0 there are windows, and of each the orbit, both ends and the orbits between are proved; 1 some of that is \
not, or the run was interrupted (the proved part is written); 2 usage, bad input, I/O.";
