within HydraulicTestBench.Interfaces;
partial model PartialFluid "Slot for the oil of one volume"
  extends Icons.Slot;
  parameter Types.BulkModulus beta "Stiffness of the pure oil at no pressure";
  RealInput p(unit="Pa") "Gauge pressure"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  RealOutput beta_eff(unit="Pa", nominal=1e9) "Stiffness at this pressure"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  annotation(Documentation(info="<html>
<p>How stiff the oil is at its pressure: dp/dt = &beta;<sub>eff</sub>(p)/V &Sigma;Q. The law is one equation, for
<code>beta_eff</code>, and has to be positive, so that the volume stores energy and never gives more than it took.</p>
<p><b>Source:</b> thesis Eq. 3.4.</p>
<p><b>Used by:</b> <code>fluid</code> of <code>Hydraulics.Volume</code> and <code>Hydraulics.Hose</code>.</p>
<p><b>Leaves out:</b> change of density and viscosity with pressure: volume is conserved at a node, see
<code>Port_a</code>.</p>
</html>"));
end PartialFluid;
