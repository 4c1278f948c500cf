within HydraulicTestBench.Mechanics;
model Wire "Wire that pulls and cannot push"
  extends Icons.Component;
  parameter Types.SpringConstant k_w "Stiffness";
  parameter Types.DampingConstant d_w = 0 "Damping";
  parameter Types.Length l_0 = 0 "Distance s_a - s_b of the ends at which it begins to pull";
  parameter Types.Length e_soft(min=1e-9) = 1e-5 "Stretch over which it takes hold";
  Interfaces.TranslationFlange_a flange_a "Upper end"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.TranslationFlange_b flange_b "Lower end"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Length e "Stretch, negative when slack";
  Types.Velocity e_t "Rate of the stretch";
  Types.Force F_w "Tension, never negative";
equation
  e = flange_a.s - flange_b.s - l_0;
  e_t = der(flange_a.s) - der(flange_b.s);
  F_w = Functions.endStopForce(e, e_t, k_w, d_w, e_soft);
  flange_a.f = F_w;
  flange_b.f = -F_w;
  annotation(Documentation(info="<html>
<p>F = max(0, k e + d de/dt) where the wire is stretched and 0 where it is slack, with a smooth beginning
(<code>Functions.endStopForce</code>). Positions point upwards: the lower end hangs at s<sub>a</sub> - l<sub>0</sub>
- e. Where both ends' positions are states, as those of a drum and of a mass are, no tool has to differentiate an
equation to get the rate of the stretch.</p>
<p><b>Source:</b> thesis Section 5.7, where the wire is a spring and a damper.</p>
<p><b>Valid:</b> taut and slack. The beginning takes k e<sub>soft</sub><sup>2</sup>/e from the tension.</p>
<p><b>Leaves out:</b> mass of the wire, change of stiffness with the length paid out.</p>
</html>"));
end Wire;
