within HydraulicTestBench.Functions;
function orificeFlow "Turbulent orifice, smooth through zero pressure difference, thesis Eq. 3.1"
  extends Icons.Function;
  input Types.Pressure dp "Pressure difference that drives the flow";
  input Types.Area K "Opening area, discharge coefficient included";
  input Types.Density rho "Density of oil";
  input Types.Pressure dp_smooth(min=1) "Below this difference the law turns from a square root to a straight line";
  output Types.VolumeFlowRate q "Flow, with the sign of dp";
algorithm
  q := K*sqrt(2/rho)*dp/(dp*dp + dp_smooth*dp_smooth)^0.25;
  annotation(Inline=true, smoothOrder=100, Documentation(info="<html>
<p>Q = K &radic;(2/&rho;) &Delta;p / (&Delta;p<sup>2</sup> + &Delta;p<sub>0</sub><sup>2</sup>)<sup>1/4</sup>, with
&Delta;p<sub>0</sub> = <code>dp_smooth</code>. Far from zero this is the thesis' sign(&Delta;p) K &radic;(2/&rho;
|&Delta;p|); at zero it is a straight line of slope K &radic;(2/(&rho; &Delta;p<sub>0</sub>)), where the root would be
infinitely steep and stop any solver.</p>
<p><b>Effect of the width:</b> the flow is smaller than the root's by the factor
(1 + (&Delta;p<sub>0</sub>/&Delta;p)<sup>2</sup>)<sup>-1/4</sup>: 16 percent at &Delta;p<sub>0</sub>, 0.25 percent at
10 &Delta;p<sub>0</sub>, 2.5e-5 at 100 &Delta;p<sub>0</sub>. Halving it makes the steepest slope 1.4 times steeper.</p>
<p><b>Source:</b> thesis Eq. 3.1, 3.2 and 3.6; the smoothing is this library's.</p>
<p><b>Valid:</b> any difference of either sign; infinitely often differentiable for dp_smooth above 0.</p>
<p><b>Leaves out:</b> laminar flow as physics (the straight line is a numerical aid), cavitation, viscosity.</p>
</html>"));
end orificeFlow;
