within HydraulicTestBench.Mechanics;
model TorqueSource "Torque that a signal prescribes"
  extends Icons.Component;
  Interfaces.RealInput tau(unit="N.m") "Torque on what is connected"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.Flange_b flange "Shaft"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
equation
  flange.tau = -tau;
  annotation(Documentation(info="<html>
<p>A positive signal drives the shaft towards positive speed.</p>
<p><b>Source:</b> thesis Eq. 5.8 gives the torque of a motor by its pressure difference.</p>
<p><b>Valid:</b> any torque.</p>
</html>"));
end TorqueSource;
