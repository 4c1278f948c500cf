within HydraulicTestBench.Interfaces;
partial model PartialSupply "Slot for the pressure supply of the valve"
  extends Icons.Slot;
  parameter Types.Pressure pS "Supply pressure at no flow";
  Port_b port "To the P port of the valve"
    annotation(Placement(transformation(extent={{-10, 90}, {10, 110}})));
  Types.VolumeFlowRate Q "Flow delivered, negative where the valve pushes oil back";
  Types.Pressure dp "Loss of supply pressure";
equation
  port.p = pS - dp;
  Q = -port.q;
  annotation(Documentation(info="<html>
<p>The supply's pressure is pS - dp. Q is the signed flow through the open P edge of the valve. The law is one equation
that gives dp from Q; in the base model dp = 0. A law without a lag on Q would make an algebraic loop with the
valve.</p>
<p><b>Source:</b> thesis Eq. 3.1, p<sub>P</sub>.</p>
</html>"));
end PartialSupply;
