within HydraulicTestBench.Interfaces;
partial model PartialSwashPlate "Slot for the way from a pump's command to its angle"
  extends Icons.Slot;
  parameter Types.Angle alphaMAX "Largest swash plate angle";
  RealInput alphaCMD(unit="%") "Swash plate angle command"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput alphaCMD_t(unit="%/s") "Its rate where known, else 0"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  RealOutput alpha(unit="rad") "Swash plate angle"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  RealOutput alpha_t(unit="rad/s") "Its rate"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  RealOutput alphaPercent(unit="%") "Swash plate angle as fed back and logged"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  annotation(Documentation(info="<html>
<p>The law is three equations, for alpha, alpha_t = d alpha/dt and alphaPercent.</p>
<p><b>Source:</b> thesis Eq. 5.18, Fig. 3.12.</p>
<p><b>Used by:</b> <code>plate</code> of <code>LoadCircuit.OpenTestBench</code> and
<code>Crane.HydraulicCompensation</code>.</p>
</html>"));
end PartialSwashPlate;
