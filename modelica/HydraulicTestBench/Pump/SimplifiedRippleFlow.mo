within HydraulicTestBench.Pump;
model SimplifiedRippleFlow "Flow of a pump with the simplified ripple, thesis Eq. 3.53 to 3.66"
  extends Interfaces.PartialPumpFlow;
  final parameter Integer strokes = (if N_p == 2*div(N_p, 2) then 1 else 2)*N_p "Ripple strokes per revolution";
  Real share(unit="1") "Flow over the mean flow";
equation
  share = 1 + psi*eta_r*(abs(sin(0.5*strokes*theta)) - 2/Constants.pi);
  QPA = share*QBar;
  QPB = -QPA;
  tau = share*alpha/alphaMAX*V_d_max/(2*Constants.pi)*(port_A.p - port_B.p);
  annotation(Documentation(info="<html>
<p>The mean flow with the arches of a rectified sine, as many per revolution as there are pistons, or twice as many if
their number is odd. The spikes at the bottom are cut off.</p>
<p><b>Source:</b> thesis Eq. 3.53 to 3.66. It follows the angle of the shaft, 2&pi; f<sub>r</sub> t of Eq. 3.53 at
constant speed, so that the ripple stays with
the pistons while the speed changes. Its corners stand where a piston turns round, as those of
<code>PistonKinematicsFlow</code> would if the ports changed there. Eq. 3.53 is read as A<sub>r</sub> |sin| +
O<sub>r</sub>: with A<sub>r</sub> inside
the bars as printed, the mean would not be zero at negative angles.</p>
<p><b>Valid:</b> speed and angle of either sign; &eta;<sub>r</sub> has to be that of N<sub>p</sub> (Fig. 3.10), here for
9. No event: the corners are smooth to a solver's step control.</p>
<p><b>Leaves out:</b> the spikes of the true ripple; flow from the swash plate's own motion; compression of the oil in
the pistons.</p>
</html>"));
end SimplifiedRippleFlow;
