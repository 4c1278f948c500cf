within HydraulicTestBench.Functions;
function flooredVolume "Volume that never falls below a floor, smooth"
  extends Icons.Function;
  input Types.Volume V "Volume by geometry, of any sign";
  input Types.Volume V_min "Floor, above 0";
  output Types.Volume V_eff "V where it is well above the floor, never below V_min";
protected
  Types.Volume excess "Distance from the floor";
algorithm
  excess := V - V_min;
  V_eff := V_min + 0.5*(excess + sqrt(excess*excess + 0.04*V_min*V_min));
  annotation(Inline=true, smoothOrder=100, Documentation(info="<html>
<p>V<sub>eff</sub> = V<sub>min</sub> + (d + &radic;(d<sup>2</sup> + (0.2 V<sub>min</sub>)<sup>2</sup>))/2 with
d = V - V<sub>min</sub>.</p>
<p><b>Source:</b> this library. In the denominator of thesis Eq. 3.5, V<sub>0</sub> - A<sub>p</sub> x<sub>p</sub>
reaches zero inside the stroke with the locked parameter set: 21.1 cm<sup>3</sup> of dead volume against
21.5 cm<sup>3</sup> swept from mid-stroke to the end.</p>
<p><b>Valid:</b> any V. It exceeds V by a share of 0.01 (V<sub>min</sub>/V)<sup>2</sup>: 1e-6 at a hundred
times the floor, 1e-4 at ten times.</p>
<p><b>Leaves out:</b> what the real chamber does there; the thesis does not say.</p>
</html>"));
end flooredVolume;
