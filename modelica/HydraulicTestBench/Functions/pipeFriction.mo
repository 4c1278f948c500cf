within HydraulicTestBench.Functions;
function pipeFriction "Pressure gradient of steady flow through a round bore, laminar to turbulent"
  extends Icons.Function;
  input Types.VolumeFlowRate q "Flow";
  input Types.Length d "Diameter";
  input Types.Density rho "Density of oil";
  input Types.KinematicViscosity nu "Kinematic viscosity, above 0";
  input Real roughness(unit="1") "Height of the wall's roughness over the diameter";
  output Real gradient(unit="Pa/m") "Loss of pressure over length, with the sign of q";
protected
  Types.Velocity v "Mean velocity";
  Real Re(unit="1") "Reynolds number, at least 1";
  Real A(unit="1") "Churchill's term of turbulent flow";
  Real B(unit="1") "Churchill's term of the transition";
  Real excess(unit="1") "Twelfth power of the friction over that of laminar flow, less 1";
algorithm
  v := 4*q/(Constants.pi*d*d);
  Re := max(abs(v)*d/nu, 1);
  A := (-2.457*log((7/Re)^0.9 + 0.27*roughness))^16;
  B := (37530/Re)^16;
  excess := (Re/8)^12/(A + B)^1.5;
  gradient := 32*rho*nu*v/(d*d)*(1 + excess)^(1/12);
  annotation(Inline=true, Documentation(info="<html>
<p>The law of Hagen and Poiseuille, 32 &rho;&nu;v/d<sup>2</sup>, times what Churchill's formula adds to it: nothing
up to
a Reynolds number of about 1000, the transition around 2300 and the friction of smooth or rough walls beyond. One smooth
curve, no switch.</p>
<p><b>Source:</b> S. W. Churchill, Friction-factor equation spans all fluid-flow regimes, Chemical Engineering 84 (1977)
91.</p>
<p><b>Valid:</b> any flow; turbulent friction as Colebrook's within some percent. In the transition real pipes
scatter.</p>
<p><b>Leaves out:</b> that friction of flow which changes fast is larger (Zielke 1968).</p>
</html>"));
end pipeFriction;
